// A renderer with multisampled targets that stores what it resolves, and pipelines of another count.
#import <Metal/Metal.h>
#import <MetalKit/MetalKit.h>

@interface Renderer ()
@property (nonatomic, strong) id<MTLTexture> colorTexture;
@property (nonatomic, strong) id<MTLTexture> resolveTexture;
@end

@implementation Renderer {
    id<MTLDevice> _device;
    id<MTLCommandQueue> _queue;
    id<MTLRenderPipelineState> _pipeline;
    id<MTLTexture> _depthTexture, _history;
}

- (instancetype)initWithDevice:(nonnull id<MTLDevice>)device {
    self = [super init];
    if (self) {
        _device = device;
        _queue = [_device newCommandQueue];
        MTLRenderPipelineDescriptor *descriptor = [[MTLRenderPipelineDescriptor alloc] init];
        descriptor.label = @"Opaque: [all]";
        descriptor.rasterSampleCount = 2;  // expect: MSAA810
        descriptor.colorAttachments[0].pixelFormat = MTLPixelFormatBGRA8Unorm;
        descriptor.depthAttachmentPixelFormat = MTLPixelFormatDepth32Float;
        NSError *error = nil;
        _pipeline = [_device newRenderPipelineStateWithDescriptor:descriptor error:&error];
    }
    return self;
}

- (void)resizeToWidth:(NSUInteger)width height:(NSUInteger)height {
    MTLTextureDescriptor *descriptor = [MTLTextureDescriptor texture2DDescriptorWithPixelFormat:MTLPixelFormatBGRA8Unorm
                                                                                          width:width
                                                                                         height:height
                                                                                      mipmapped:NO];
    descriptor.usage = MTLTextureUsageRenderTarget | MTLTextureUsageShaderRead;
    self.resolveTexture = [_device newTextureWithDescriptor:descriptor];

    descriptor.textureType = MTLTextureType2DMultisample;
    descriptor.sampleCount = 4;
    descriptor.usage = MTLTextureUsageRenderTarget;
    descriptor.storageMode = MTLStorageModePrivate;
    self.colorTexture = [_device newTextureWithDescriptor:descriptor];
    descriptor.pixelFormat = MTLPixelFormatDepth32Float;
    _depthTexture = [_device newTextureWithDescriptor:descriptor];
}

- (void)drawInView:(MTKView *)view {
    @autoreleasepool {
        id<MTLCommandBuffer> commandBuffer = [_queue commandBuffer];
        MTLRenderPassDescriptor *pass = [MTLRenderPassDescriptor renderPassDescriptor];
        pass.colorAttachments[0].texture = self.colorTexture;
        pass.colorAttachments[0].resolveTexture = self.resolveTexture;
        pass.colorAttachments[0].loadAction = MTLLoadActionClear;
        pass.colorAttachments[0].storeAction = MTLStoreActionStoreAndMultisampleResolve;  // expect: MSAA801
        pass.depthAttachment.texture = _depthTexture;
        pass.depthAttachment.loadAction = MTLLoadActionClear;
        [pass.depthAttachment setStoreAction:MTLStoreActionStore];  // expect: MSAA802
        id<MTLRenderCommandEncoder> encoder = [commandBuffer renderCommandEncoderWithDescriptor:pass];
        [encoder setRenderPipelineState:_pipeline];
        [encoder drawPrimitives:MTLPrimitiveTypeTriangle vertexStart:0 vertexCount:3];
        [encoder endEncoding];
        [commandBuffer addCompletedHandler:^(id<MTLCommandBuffer> buffer) { NSLog(@"done"); }];
        id<MTLBlitCommandEncoder> blit = [commandBuffer blitCommandEncoder];
        [blit copyFromTexture:self.resolveTexture toTexture:_history];
        [blit endEncoding];
        [commandBuffer presentDrawable:view.currentDrawable];
        [commandBuffer commit];
    }
}
@end
