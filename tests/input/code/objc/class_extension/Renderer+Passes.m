#import "Renderer+Private.h"

@implementation Renderer (Passes)

- (void)drawInto:(id<MTLTexture>)target commandBuffer:(id<MTLCommandBuffer>)commandBuffer {
    MTLRenderPassDescriptor *pass = [MTLRenderPassDescriptor renderPassDescriptor];
    MTLRenderPassColorAttachmentDescriptor *color = pass.colorAttachments[0];
    color.texture = self.colorTexture;
    color.resolveTexture = target;
    color.loadAction = MTLLoadActionClear;
    color.storeAction = MTLStoreActionMultisampleResolve;
    pass.depthAttachment.texture = self.depthTexture;
    pass.depthAttachment.loadAction = MTLLoadActionClear;
    pass.depthAttachment.storeAction = MTLStoreActionStore;  // expect: MSAA802
    [[commandBuffer renderCommandEncoderWithDescriptor:pass] endEncoding];
}

@end
