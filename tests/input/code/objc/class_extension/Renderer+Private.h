#import "Renderer.h"

static const NSUInteger kSampleCount = 4;

@interface Renderer ()
@property (nonatomic) id<MTLTexture> depthTexture;
@end
