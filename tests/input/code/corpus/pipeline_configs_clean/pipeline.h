#pragma once
#include <vulkan/vulkan.h>

struct Context {
    VkDevice device;
    VkFormat format;
    VkSampleCountFlagBits levels() const { return samples; }
    VkSampleCountFlagBits samples;
};

struct PipelineConfig {
    VkSampleCountFlagBits samples{VK_SAMPLE_COUNT_1_BIT};
    bool depthTest{true};
};

struct Target {
    VkImage image;
    VkSampleCountFlagBits samples;
};

struct Targets {
    Target scene;
};

class Pass {
public:
    void createScene(Context& context, VkSampleCountFlagBits samples);
    void createScreen(Context& context, VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT);
    VkRenderPass handle() const { return handle_; }

private:
    VkRenderPass handle_;
};

class Pipeline {
public:
    Pipeline(Context& context, const PipelineConfig& config) : config_(config) {}

protected:
    void create(Context& context, VkRenderPass pass);

    PipelineConfig config_;
    Pass pass_;
    VkPipeline pipeline_;
};

class GridPipeline : public Pipeline {
public:
    GridPipeline(Context& context, Targets* targets);
};

class ToneMapPipeline : public Pipeline {
public:
    explicit ToneMapPipeline(Context& context);
};
