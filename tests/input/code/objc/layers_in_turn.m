// A kernel draws its layers one after another, each reading what is below it: the encoder is ended and begun again between them, so that
// the samples go to memory and back for each layer.
#import <Metal/Metal.h>

@interface LayerKernel : NSObject
- (instancetype)initWithDevice:(id<MTLDevice>)device sampleCount:(NSUInteger)sampleCount;
- (void)encodeLayers:(NSArray<id<MTLTexture>> *)layers into:(id<MTLTexture>)target commands:(id<MTLCommandBuffer>)commands;
@end

@implementation LayerKernel {
    id<MTLDevice> _device;
    id<MTLRenderPipelineState> _pipeline;
    NSUInteger _sampleCount;
}

- (instancetype)initWithDevice:(id<MTLDevice>)device sampleCount:(NSUInteger)sampleCount {
    if (self = [super init]) {
        NSParameterAssert(sampleCount >= 1);
        _device = device;
        _sampleCount = sampleCount;
    }
    return self;
}

- (void)encodeLayers:(NSArray<id<MTLTexture>> *)layers into:(id<MTLTexture>)target commands:(id<MTLCommandBuffer>)commands {
    MTLRenderPassDescriptor *pass = [MTLRenderPassDescriptor renderPassDescriptor];
    if (_sampleCount > 1) {
        MTLTextureDescriptor *samples = [MTLTextureDescriptor texture2DDescriptorWithPixelFormat:target.pixelFormat
                                                                                           width:target.width
                                                                                          height:target.height
                                                                                       mipmapped:NO];
        samples.textureType = MTLTextureType2DMultisample;
        samples.usage = MTLTextureUsageRenderTarget;
        samples.sampleCount = _sampleCount;
        samples.storageMode = MTLStorageModePrivate;
        pass.colorAttachments[0].texture = [_device newTextureWithDescriptor:samples];
        pass.colorAttachments[0].loadAction = MTLLoadActionDontCare;
        pass.colorAttachments[0].storeAction = MTLStoreActionStoreAndMultisampleResolve;
        pass.colorAttachments[0].resolveTexture = target;
    } else {
        pass.colorAttachments[0].texture = target;
        pass.colorAttachments[0].loadAction = MTLLoadActionDontCare;
        pass.colorAttachments[0].storeAction = MTLStoreActionStore;
    }
    __block id<MTLRenderCommandEncoder> encoder = [commands renderCommandEncoderWithDescriptor:pass];
    for (id<MTLTexture> layer in layers) {
        [encoder endEncoding];
        pass.colorAttachments[0].loadAction = MTLLoadActionLoad;  // expect: MSAA808
        encoder = [commands renderCommandEncoderWithDescriptor:pass];
        [encoder setRenderPipelineState:_pipeline];
        [encoder setFragmentTexture:layer atIndex:0];
        [encoder drawPrimitives:MTLPrimitiveTypeTriangle vertexStart:0 vertexCount:6];
    }
    [encoder endEncoding];
}

@end
