// An engine names its constants by macros, and fills in passes and releases objects through them.
#import <Metal/Metal.h>

#define ENGINE_SAMPLES 4
#define ENGINE_TYPE MTLTextureType2DMultisample
#define ENGINE_RELEASE(object) [object release]
#define ENGINE_ATTACH(pass, index, samples, target) \
    pass.colorAttachments[index].texture = samples; \
    pass.colorAttachments[index].resolveTexture = target; \
    pass.colorAttachments[index].loadAction = MTLLoadActionClear

#if 0
#define ENGINE_SAMPLES 1
#endif

namespace engine {

class Renderer {
public:
    void draw(id<MTLCommandBuffer> commands, id<MTLTexture> target);

private:
    id<MTLDevice> device_ = nil;
};

void Renderer::draw(id<MTLCommandBuffer> commands, id<MTLTexture> target) {
    MTLTextureDescriptor *description = [[MTLTextureDescriptor alloc] init];
    description.textureType = ENGINE_TYPE;
    description.usage = MTLTextureUsageRenderTarget;
    description.storageMode = MTLStorageModePrivate;
    description.sampleCount = ENGINE_SAMPLES;
    id<MTLTexture> samples = [device_ newTextureWithDescriptor:description];
    ENGINE_RELEASE(description);
    MTLRenderPassDescriptor *pass = [MTLRenderPassDescriptor renderPassDescriptor];
    ENGINE_ATTACH(pass, 0, samples, target);
    pass.colorAttachments[0].storeAction = MTLStoreActionStoreAndMultisampleResolve;  // expect: MSAA801
    id<MTLRenderCommandEncoder> encoder = [commands renderCommandEncoderWithDescriptor:pass];
    [encoder endEncoding];
    ENGINE_RELEASE(samples);
}

}  // namespace engine
