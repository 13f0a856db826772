// The public part of a rendering library: what callers choose by enumerators.
#ifndef GPU_H
#define GPU_H

#include <stdbool.h>
#include <stdint.h>

typedef enum { GPU_LOAD_KEEP, GPU_LOAD_CLEAR, GPU_LOAD_ANY } GpuLoad;
typedef enum { GPU_STORE_KEEP, GPU_STORE_ANY, GPU_STORE_RESOLVE, GPU_STORE_RESOLVE_AND_KEEP } GpuStore;
typedef enum { GPU_SAMPLES_1, GPU_SAMPLES_2, GPU_SAMPLES_4, GPU_SAMPLES_8 } GpuSamples;

typedef struct {
    uint32_t format;
    GpuSamples samples;
    GpuLoad load;
    GpuStore store;
    bool resolves;
} GpuTarget;

typedef struct Gpu Gpu;

void *GpuMakePass(Gpu *gpu, const GpuTarget *targets, uint32_t count);
void *GpuMakeOverlayPass(Gpu *gpu, uint32_t format);
void *GpuMakeCompatiblePass(Gpu *gpu, uint32_t format, GpuSamples samples);

#endif
