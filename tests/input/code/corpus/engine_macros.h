// Not read by the test: macros_by_shape.c is checked alone. It is here so that compilers accept that program.
#include <string.h>

#define ENGINE_STRUCT(type, name) \
    type name;                    \
    memset(&name, 0, sizeof(name))
#define ENGINE_STRUCT_LIST(type, name, count) \
    type name[count];                         \
    memset(name, 0, sizeof(name))
#define ENGINE_COUNT(list) (sizeof(list) / sizeof((list)[0]))
#define Engine_Zero(memory, value, size) memset(memory, value, size)
