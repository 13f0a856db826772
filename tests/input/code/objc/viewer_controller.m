// A viewer with properties: one descriptor makes five textures, the pass has a method of its own, and post-processing draws to one sample.
// The samples are resolved and not stored, so that there is nothing to report.
#import <MetalKit/MetalKit.h>

@interface ViewerController : NSObject <MTKViewDelegate>
@property (nonatomic, strong) id<MTLDevice> device;
@property (nonatomic, strong) id<MTLCommandQueue> queue;
@property (nonatomic, weak) MTKView *metalView;
@property (nonatomic, assign) NSInteger sampleCount;
@property (nonatomic, assign) MTLPixelFormat colorPixelFormat;
@property (nonatomic, strong) id<MTLTexture> multisampleTexture;
@property (nonatomic, strong) id<MTLTexture> colorTexture;
@property (nonatomic, strong) id<MTLTexture> depthTexture;
@property (nonatomic, strong) id<MTLTexture> bloomTexture;
@property (nonatomic, strong) id<MTLRenderPipelineState> bloomPipeline;
@end

@implementation ViewerController

- (instancetype)initWithView:(MTKView *)view {
    if ((self = [super init])) {
        _device = view.device;
        _queue = [_device newCommandQueue];
        _metalView = view;
        _sampleCount = [_device supportsTextureSampleCount:4] ? 4 : 1;
        _colorPixelFormat = MTLPixelFormatRGBA16Float;
    }
    return self;
}

- (void)makeFramebuffer:(CGSize)size {
    MTLTextureDescriptor *descriptor = [MTLTextureDescriptor new];
    descriptor.width = size.width;
    descriptor.height = size.height;
    descriptor.textureType = self.sampleCount > 1 ? MTLTextureType2DMultisample : MTLTextureType2D;
    descriptor.pixelFormat = self.colorPixelFormat;
    descriptor.sampleCount = self.sampleCount;
    descriptor.storageMode = MTLStorageModePrivate;
    descriptor.usage = MTLTextureUsageRenderTarget;
    self.multisampleTexture = [self.device newTextureWithDescriptor:descriptor];

    descriptor.textureType = MTLTextureType2D;
    descriptor.sampleCount = 1;
    descriptor.usage = MTLTextureUsageRenderTarget | MTLTextureUsageShaderRead;
    self.colorTexture = [self.device newTextureWithDescriptor:descriptor];

    descriptor.textureType = self.sampleCount > 1 ? MTLTextureType2DMultisample : MTLTextureType2D;
    descriptor.pixelFormat = MTLPixelFormatDepth32Float;
    descriptor.sampleCount = self.sampleCount;
    descriptor.usage = MTLTextureUsageRenderTarget;
    self.depthTexture = [self.device newTextureWithDescriptor:descriptor];

    descriptor.width = size.width / 2;
    descriptor.height = size.height / 2;
    descriptor.textureType = MTLTextureType2D;
    descriptor.pixelFormat = self.colorPixelFormat;
    descriptor.sampleCount = 1;
    descriptor.usage = MTLTextureUsageRenderTarget | MTLTextureUsageShaderRead;
    self.bloomTexture = [self.device newTextureWithDescriptor:descriptor];
}

- (MTLRenderPassDescriptor *)scenePass {
    MTLRenderPassDescriptor *pass = [MTLRenderPassDescriptor renderPassDescriptor];
    if (self.sampleCount > 1) {
        pass.colorAttachments[0].texture = self.multisampleTexture;
        pass.colorAttachments[0].resolveTexture = self.colorTexture;
        pass.colorAttachments[0].loadAction = MTLLoadActionClear;
        pass.colorAttachments[0].storeAction = MTLStoreActionMultisampleResolve;
    } else {
        pass.colorAttachments[0].texture = self.colorTexture;
        pass.colorAttachments[0].loadAction = MTLLoadActionClear;
        pass.colorAttachments[0].storeAction = MTLStoreActionStore;
    }
    pass.depthAttachment.texture = self.depthTexture;
    pass.depthAttachment.loadAction = MTLLoadActionClear;
    pass.depthAttachment.storeAction = MTLStoreActionDontCare;
    return pass;
}

- (void)encodeBloom:(id<MTLCommandBuffer>)commands {
    MTLRenderPassDescriptor *pass = [MTLRenderPassDescriptor renderPassDescriptor];
    pass.colorAttachments[0].texture = self.bloomTexture;
    pass.colorAttachments[0].loadAction = MTLLoadActionDontCare;
    pass.colorAttachments[0].storeAction = MTLStoreActionStore;
    id<MTLRenderCommandEncoder> encoder = [commands renderCommandEncoderWithDescriptor:pass];
    [encoder setRenderPipelineState:self.bloomPipeline];
    [encoder setFragmentTexture:self.colorTexture atIndex:0];
    [encoder drawPrimitives:MTLPrimitiveTypeTriangle vertexStart:0 vertexCount:3];
    [encoder endEncoding];
}

- (void)encodeToneMapping:(id<MTLCommandBuffer>)commands {
    if (self.metalView.currentRenderPassDescriptor != nil) {
        id<MTLRenderCommandEncoder> encoder = [commands renderCommandEncoderWithDescriptor:self.metalView.currentRenderPassDescriptor];
        [encoder setFragmentTexture:self.colorTexture atIndex:0];
        [encoder setFragmentTexture:self.bloomTexture atIndex:1];
        [encoder drawPrimitives:MTLPrimitiveTypeTriangle vertexStart:0 vertexCount:3];
        [encoder endEncoding];
    }
}

- (void)drawInMTKView:(nonnull MTKView *)view {
    id<MTLCommandBuffer> commands = [self.queue commandBuffer];
    id<MTLRenderCommandEncoder> encoder = [commands renderCommandEncoderWithDescriptor:[self scenePass]];
    [encoder endEncoding];
    [self encodeBloom:commands];
    [self encodeToneMapping:commands];
    [commands presentDrawable:view.currentDrawable];
    [commands commit];
}

- (void)mtkView:(nonnull MTKView *)view drawableSizeWillChange:(CGSize)size {
    [self makeFramebuffer:size];
}

@end
