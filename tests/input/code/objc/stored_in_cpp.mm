// Objective-C++: messages inside classes of C++, an attachment in a variable, and one passed to a function.
#import <Metal/Metal.h>
#import <QuartzCore/CAMetalLayer.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace render {

struct TargetInfo {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t samples = 4;
};

static void clearTo(MTLRenderPassColorAttachmentDescriptor* attachment, double gray) {
    attachment.loadAction = MTLLoadActionClear;
    attachment.clearColor = MTLClearColorMake(gray, gray, gray, 1.0);
}

class Frame {
public:
    Frame(id<MTLDevice> device, const TargetInfo& info) : device_{device}, info_{info} { createTargets(); }

    void draw(id<MTLCommandBuffer> commands, id<CAMetalDrawable> drawable) {
        @autoreleasepool {
            MTLRenderPassDescriptor* pass = [MTLRenderPassDescriptor renderPassDescriptor];
            MTLRenderPassColorAttachmentDescriptor* color = pass.colorAttachments[0];
            color.texture = samples_;
            color.resolveTexture = drawable.texture;
            color.storeAction = MTLStoreActionStoreAndMultisampleResolve;  // expect: MSAA801
            clearTo(color, 0.2);
            pass.depthAttachment.texture = depth_;
            pass.depthAttachment.loadAction = MTLLoadActionClear;
            pass.depthAttachment.storeAction = MTLStoreActionStore;  // expect: MSAA802
            id<MTLRenderCommandEncoder> encoder = [commands renderCommandEncoderWithDescriptor:pass];
            [encoder setRenderPipelineState:pipeline_];
            [encoder drawPrimitives:MTLPrimitiveTypeTriangle vertexStart:0 vertexCount:3];
            [encoder endEncoding];
            [commands presentDrawable:drawable];
        }
    }

private:
    void createTargets() {
        MTLTextureDescriptor* desc = [[MTLTextureDescriptor alloc] init];
        desc.textureType = MTLTextureType2DMultisample;
        desc.width = info_.width;
        desc.height = info_.height;
        desc.sampleCount = 4;
        desc.storageMode = MTLStorageModePrivate;
        desc.usage = MTLTextureUsageRenderTarget;
        desc.pixelFormat = MTLPixelFormatBGRA8Unorm;
        samples_ = [device_ newTextureWithDescriptor:desc];
        desc.pixelFormat = MTLPixelFormatDepth32Float;
        depth_ = [device_ newTextureWithDescriptor:desc];
    }

    id<MTLDevice> device_ = nil;
    id<MTLTexture> samples_ = nil;
    id<MTLTexture> depth_ = nil;
    id<MTLRenderPipelineState> pipeline_ = nil;
    TargetInfo info_;
};

}  // namespace render
