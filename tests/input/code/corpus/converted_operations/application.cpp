// Two passes of an application: the first stores what it resolves, the second does not.
#include "render_pass_vk.h"

RenderPassVk CreateScenePass(VkDevice Device) {
    RenderPassAttachmentDesc Attachments[2];
    Attachments[0].Format = TEX_FORMAT_RGBA8;
    Attachments[0].SampleCount = 4;
    Attachments[0].LoadOp = ATTACHMENT_LOAD_OP_CLEAR;
    Attachments[0].StoreOp = ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    Attachments[1].Format = TEX_FORMAT_RGBA8;
    Attachments[1].SampleCount = 1;
    Attachments[1].LoadOp = ATTACHMENT_LOAD_OP_DISCARD;
    Attachments[1].StoreOp = ATTACHMENT_STORE_OP_STORE;
    RenderPassDesc Desc;
    Desc.AttachmentCount = 2;
    Desc.pAttachments = Attachments;
    Desc.Resolves = true;
    return RenderPassVk{Device, Desc};
}

RenderPassVk CreateOverlayPass(VkDevice Device) {
    RenderPassAttachmentDesc Attachments[2];
    Attachments[0] = {TEX_FORMAT_RGBA8, 4, ATTACHMENT_LOAD_OP_CLEAR, ATTACHMENT_STORE_OP_DISCARD};
    Attachments[1] = {TEX_FORMAT_RGBA8, 1, ATTACHMENT_LOAD_OP_DISCARD, ATTACHMENT_STORE_OP_STORE};
    RenderPassDesc Desc;
    Desc.AttachmentCount = 2;
    Desc.pAttachments = Attachments;
    Desc.Resolves = true;
    return RenderPassVk{Device, Desc};
}
