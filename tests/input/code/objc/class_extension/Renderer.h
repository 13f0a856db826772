#import <Metal/Metal.h>

NS_ASSUME_NONNULL_BEGIN

@interface Renderer : NSObject
@property (nonatomic, readonly) id<MTLDevice> device;
@property (nonatomic, readonly, nullable) id<MTLTexture> colorTexture;
- (instancetype)initWithDevice:(id<MTLDevice>)device;
- (void)resizeToWidth:(NSUInteger)width height:(NSUInteger)height;
@end

@interface Renderer (Passes)
- (void)drawInto:(id<MTLTexture>)target commandBuffer:(id<MTLCommandBuffer>)commandBuffer;
@end

NS_ASSUME_NONNULL_END
