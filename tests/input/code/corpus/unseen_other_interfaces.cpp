// Multisampling by other interfaces, whose names are alike: none of it is Vulkan's, and nothing of it may be judged as if it were.
#include <cstdint>
#include <vector>

extern "C" {
typedef enum WGPULoadOp { WGPULoadOp_Clear = 1, WGPULoadOp_Load = 2 } WGPULoadOp;
typedef enum WGPUStoreOp { WGPUStoreOp_Store = 1, WGPUStoreOp_Discard = 2 } WGPUStoreOp;
typedef struct WGPUTextureViewImpl* WGPUTextureView;
typedef struct WGPURenderPassColorAttachment {
    WGPUTextureView view, resolveTarget;
    WGPULoadOp loadOp;
    WGPUStoreOp storeOp;
} WGPURenderPassColorAttachment;
typedef struct WGPUMultisampleState {
    uint32_t count, mask;
    bool alphaToCoverageEnabled;
} WGPUMultisampleState;
void wgpuBegin(const WGPURenderPassColorAttachment* attachment);

void glTexImage2DMultisample(unsigned target, int samples, unsigned format, int width, int height, bool fixed);
void glRenderbufferStorageMultisample(unsigned target, int samples, unsigned format, int width, int height);
void glBlitFramebuffer(int, int, int, int, int, int, int, int, unsigned, unsigned);
}

struct DXGI_SAMPLE_DESC {
    unsigned Count, Quality;
};
struct D3D12_RESOURCE_DESC {
    unsigned Width, Height;
    DXGI_SAMPLE_DESC SampleDesc;
    unsigned Flags;
};
struct D3D12_BLEND_DESC {
    bool AlphaToCoverageEnable, IndependentBlendEnable;
};

namespace MTL {
enum StoreAction { StoreActionDontCare, StoreActionStore, StoreActionMultisampleResolve, StoreActionStoreAndMultisampleResolve };
class RenderPassColorAttachmentDescriptor {
public:
    void setStoreAction(StoreAction action);
    void setTexture(void* texture);
    void setResolveTexture(void* texture);
};
}  // namespace MTL

// A program's own structure with Vulkan's member names.
struct Description {
    int samples = 4;
    int loadOp = 1;
    int storeOp = 0;
    int sampleShadingEnable = 1;
    float minSampleShading = 0.2f;
    int rasterizationSamples = 1;
    bool alphaToCoverageEnable = true;
};

void webgpu(WGPUTextureView view, WGPUTextureView resolve) {
    WGPURenderPassColorAttachment attachment = {view, resolve, WGPULoadOp_Clear, WGPUStoreOp_Store};
    wgpuBegin(&attachment);
    WGPUMultisampleState multisample = {.count = 1, .mask = ~0u, .alphaToCoverageEnabled = true};
    (void)multisample;
}

void opengl(int width, int height) {
    glTexImage2DMultisample(0x9100, 16, 0x8058, width, height, true);
    glRenderbufferStorageMultisample(0x8D41, 16, 0x88F0, width, height);
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, 0x4000, 0x2600);
}

D3D12_RESOURCE_DESC direct3d(unsigned width, unsigned height) {
    D3D12_RESOURCE_DESC desc = {};
    desc.Width = width;
    desc.Height = height;
    desc.SampleDesc.Count = 8;
    desc.Flags = 1;
    D3D12_BLEND_DESC blend = {true, false};
    (void)blend;
    return desc;
}

void metal(MTL::RenderPassColorAttachmentDescriptor& attachment, void* samples, void* resolved) {
    attachment.setTexture(samples);
    attachment.setResolveTexture(resolved);
    attachment.setStoreAction(MTL::StoreActionStoreAndMultisampleResolve);
}

std::vector<Description> own() {
    Description multisampled;
    Description resolve = multisampled;
    resolve.samples = 1;
    multisampled.storeOp = 0;
    return {multisampled, resolve};
}
