// Each kind of pipeline has a configuration of its own, of which one states a sample count.
#include "pipeline.h"

struct PipelineStates {
    VkPipelineMultisampleStateCreateInfo multisampling{};

    PipelineStates()
        : multisampling({
              .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
              .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT,
              .sampleShadingEnable = VK_FALSE,
          }) {}
};

void Pipeline::create(Context& context, VkRenderPass pass) {
    PipelineStates states;
    if (config_.samples != VK_SAMPLE_COUNT_1_BIT) {
        states.multisampling.rasterizationSamples = config_.samples;
    }
    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.pMultisampleState = &states.multisampling;
    info.renderPass = pass;
    info.subpass = 0;
    vkCreateGraphicsPipelines(context.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_);
}

GridPipeline::GridPipeline(Context& context, Targets* targets) : Pipeline(context, {.samples = targets->scene.samples}) {
    pass_.createScene(context, config_.samples);
    create(context, pass_.handle());
}

ToneMapPipeline::ToneMapPipeline(Context& context) : Pipeline(context, {.depthTest = false}) {
    pass_.createScreen(context);
    create(context, pass_.handle());
}
