#include "shared.h"

#include <string.h>

void Mem_Set(void *memory, int value, size_t size) {
    memset(memory, value, size);
}
