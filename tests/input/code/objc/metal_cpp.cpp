// Metal from C++, without messages.
#include <Metal/Metal.hpp>
#include <QuartzCore/QuartzCore.hpp>

class Renderer {
public:
    explicit Renderer(MTL::Device* device) : device_(device), queue_(device->newCommandQueue()) {
        createTargets(1280, 720);
        createPipeline();
    }

    void draw(CA::MetalDrawable* drawable) {
        NS::AutoreleasePool* pool = NS::AutoreleasePool::alloc()->init();
        MTL::CommandBuffer* commands = queue_->commandBuffer();
        MTL::RenderPassDescriptor* pass = MTL::RenderPassDescriptor::alloc()->init();
        MTL::RenderPassColorAttachmentDescriptor* color = pass->colorAttachments()->object(0);
        color->setTexture(samples_);
        color->setResolveTexture(drawable->texture());
        color->setLoadAction(MTL::LoadActionClear);
        color->setStoreAction(MTL::StoreActionMultisampleResolve);
        pass->depthAttachment()->setTexture(depth_);
        pass->depthAttachment()->setLoadAction(MTL::LoadActionClear);
        pass->depthAttachment()->setStoreAction(MTL::StoreActionStore);  // expect: MSAA802
        MTL::RenderCommandEncoder* encoder = commands->renderCommandEncoder(pass);
        encoder->setRenderPipelineState(pipeline_);
        encoder->drawPrimitives(MTL::PrimitiveTypeTriangle, NS::UInteger(0), NS::UInteger(3));
        encoder->endEncoding();
        commands->presentDrawable(drawable);
        commands->commit();
        pass->release();
        pool->release();
    }

private:
    void createTargets(NS::UInteger width, NS::UInteger height) {
        MTL::TextureDescriptor* descriptor = MTL::TextureDescriptor::alloc()->init();
        descriptor->setTextureType(MTL::TextureType2DMultisample);
        descriptor->setWidth(width);
        descriptor->setHeight(height);
        descriptor->setSampleCount(4);
        descriptor->setUsage(MTL::TextureUsageRenderTarget);
        descriptor->setStorageMode(MTL::StorageModePrivate);
        descriptor->setPixelFormat(MTL::PixelFormatBGRA8Unorm);
        samples_ = device_->newTexture(descriptor);
        descriptor->setPixelFormat(MTL::PixelFormatDepth32Float);
        depth_ = device_->newTexture(descriptor);
        descriptor->release();
    }

    void createPipeline() {
        MTL::RenderPipelineDescriptor* descriptor = MTL::RenderPipelineDescriptor::alloc()->init();
        descriptor->colorAttachments()->object(0)->setPixelFormat(MTL::PixelFormatBGRA8Unorm);
        descriptor->setDepthAttachmentPixelFormat(MTL::PixelFormatDepth32Float);
        descriptor->setRasterSampleCount(4);
        NS::Error* error = nullptr;
        pipeline_ = device_->newRenderPipelineState(descriptor, &error);
        descriptor->release();
    }

    MTL::Device* device_;
    MTL::CommandQueue* queue_;
    MTL::Texture* samples_ = nullptr;
    MTL::Texture* depth_ = nullptr;
    MTL::RenderPipelineState* pipeline_ = nullptr;
};
