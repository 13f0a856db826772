// An interface over several graphics APIs: actions by a function with a switch, or by a table, counts by a table. The caller decides.
#import <Metal/Metal.h>

#include <cstdint>
#include <memory>

namespace api {

enum class StoreOp : uint8_t { DontCare, Store, Resolve, ResolveAndStore };
enum class LoadOp : uint8_t { Load, Clear, DontCare };

struct ColorTarget {
    id<MTLTexture> texture = nil;
    id<MTLTexture> resolve = nil;
    LoadOp load = LoadOp::Clear;
    StoreOp store = StoreOp::Store;
};

static const MTLLoadAction loadActions[] = {MTLLoadActionLoad, MTLLoadActionClear, MTLLoadActionDontCare};
static const NSUInteger sampleCounts[] = {1, 2, 4, 8};

static MTLStoreAction toMetal(StoreOp op) {
    switch (op) {
        case StoreOp::DontCare:
            return MTLStoreActionDontCare;
        case StoreOp::Store:
            return MTLStoreActionStore;
        case StoreOp::Resolve:
            return MTLStoreActionMultisampleResolve;
        case StoreOp::ResolveAndStore:
            return MTLStoreActionStoreAndMultisampleResolve;
    }
    return MTLStoreActionDontCare;
}

class Encoder {
public:
    explicit Encoder(id<MTLCommandBuffer> commands) : commands_(commands) {}

    void begin(const ColorTarget* targets, uint32_t count) {
        MTLRenderPassDescriptor* pass = [MTLRenderPassDescriptor renderPassDescriptor];
        for (uint32_t i = 0; i < count; i++) {
            const ColorTarget& target = targets[i];
            pass.colorAttachments[i].texture = target.texture;
            pass.colorAttachments[i].loadAction = loadActions[static_cast<uint8_t>(target.load)];
            pass.colorAttachments[i].storeAction = toMetal(target.store);
            if (target.resolve != nil) {
                pass.colorAttachments[i].resolveTexture = target.resolve;
            }
        }
        encoder_ = [commands_ renderCommandEncoderWithDescriptor:pass];
    }

    id<MTLTexture> makeTarget(id<MTLDevice> device, MTLPixelFormat format, uint8_t countIndex) {
        MTLTextureDescriptor* desc = [MTLTextureDescriptor texture2DDescriptorWithPixelFormat:format width:64 height:64 mipmapped:NO];
        desc.sampleCount = sampleCounts[countIndex];
        if (desc.sampleCount > 1) {
            desc.textureType = MTLTextureType2DMultisample;
        }
        desc.usage = MTLTextureUsageRenderTarget | MTLTextureUsageShaderRead;
        return [device newTextureWithDescriptor:desc];
    }

private:
    id<MTLCommandBuffer> commands_ = nil;
    id<MTLRenderCommandEncoder> encoder_ = nil;
};

}  // namespace api
