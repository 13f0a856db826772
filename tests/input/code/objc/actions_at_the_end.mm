// The actions that store are set by the encoder at the end of the pass, from a structure that is kept beside it: nothing is known.
#import <Metal/Metal.h>

#include <algorithm>
#include <vector>

namespace game {

constexpr int MaxTargets = 8;

class Texture {
public:
    id<MTLTexture> native() const { return native_; }
    id<MTLTexture> samples() const { return samples_; }
    int count() const { return count_; }

private:
    id<MTLTexture> native_ = nil;
    id<MTLTexture> samples_ = nil;
    int count_ = 1;
};

struct StoreActions {
    MTLStoreAction color[MaxTargets];
    MTLStoreAction depth;
};

static inline void setAttachment(const Texture& texture, MTLRenderPassAttachmentDescriptor* attachment, MTLStoreAction& action) {
    attachment.texture = texture.count() > 1 ? texture.samples() : texture.native();
    attachment.loadAction = MTLLoadActionLoad;
    attachment.storeAction = MTLStoreActionUnknown;
    action = MTLStoreActionStore;
    attachment.resolveTexture = nil;
    if (texture.count() > 1) {
        action = MTLStoreActionStoreAndMultisampleResolve;
        attachment.resolveTexture = texture.native();
    }
}

class Graphics {
public:
    void setTargets(const std::vector<Texture*>& targets, Texture* depth) {
        for (size_t i = 0; i < targets.size(); i++) {
            setAttachment(*targets[i], pass_.colorAttachments[i], actions_.color[i]);
        }
        if (depth != nullptr) {
            setAttachment(*depth, pass_.depthAttachment, actions_.depth);
            actions_.depth = MTLStoreActionDontCare;
        }
        encoder_ = [commands_ renderCommandEncoderWithDescriptor:pass_];
    }

    void submit(size_t targets, bool keep) {
        for (size_t i = 0; i < targets; i++) {
            [encoder_ setColorStoreAction:(keep ? MTLStoreActionStore : actions_.color[i]) atIndex:i];
        }
        [encoder_ setDepthStoreAction:keep ? MTLStoreActionStore : actions_.depth];
        [encoder_ endEncoding];
        encoder_ = nil;
        for (int i = 0; i < MaxTargets; i++) {
            pass_.colorAttachments[i].loadAction = MTLLoadActionLoad;
        }
    }

private:
    id<MTLCommandBuffer> commands_ = nil;
    id<MTLRenderCommandEncoder> encoder_ = nil;
    MTLRenderPassDescriptor* pass_ = [MTLRenderPassDescriptor renderPassDescriptor];
    StoreActions actions_{};
};

}  // namespace game
