// The textures are made here, and drawn to in a category, which stores the depth samples for nobody.
#import "Renderer+Private.h"

@implementation Renderer

- (instancetype)initWithDevice:(id<MTLDevice>)device {
    if ((self = [super init])) {
        _device = device;
    }
    return self;
}

- (id<MTLTexture>)newTargetWithFormat:(MTLPixelFormat)format width:(NSUInteger)width height:(NSUInteger)height {
    MTLTextureDescriptor *descriptor = [MTLTextureDescriptor texture2DDescriptorWithPixelFormat:format
                                                                                          width:width
                                                                                         height:height
                                                                                      mipmapped:NO];
    descriptor.textureType = MTLTextureType2DMultisample;
    descriptor.sampleCount = kSampleCount;
    descriptor.usage = MTLTextureUsageRenderTarget;
    descriptor.storageMode = MTLStorageModePrivate;
    return [self.device newTextureWithDescriptor:descriptor];
}

- (void)resizeToWidth:(NSUInteger)width height:(NSUInteger)height {
    _colorTexture = [self newTargetWithFormat:MTLPixelFormatBGRA8Unorm width:width height:height];
    self.depthTexture = [self newTargetWithFormat:MTLPixelFormatDepth32Float width:width height:height];
}

@end
