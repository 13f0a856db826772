// Types that every backend of a framework shares.
#pragma once

#include <cstdint>

typedef uint8_t Uint8;
typedef uint32_t Uint32;

enum ATTACHMENT_LOAD_OP : Uint8 { ATTACHMENT_LOAD_OP_LOAD = 0, ATTACHMENT_LOAD_OP_CLEAR, ATTACHMENT_LOAD_OP_DISCARD };
enum ATTACHMENT_STORE_OP : Uint8 { ATTACHMENT_STORE_OP_STORE = 0, ATTACHMENT_STORE_OP_DISCARD };
enum TEXTURE_FORMAT : Uint8 { TEX_FORMAT_UNKNOWN = 0, TEX_FORMAT_RGBA8, TEX_FORMAT_D32 };

struct RenderPassAttachmentDesc {
    TEXTURE_FORMAT Format = TEX_FORMAT_UNKNOWN;
    Uint8 SampleCount = 1;
    ATTACHMENT_LOAD_OP LoadOp = ATTACHMENT_LOAD_OP_LOAD;
    ATTACHMENT_STORE_OP StoreOp = ATTACHMENT_STORE_OP_STORE;
};

struct RenderPassDesc {
    Uint32 AttachmentCount = 0;
    const RenderPassAttachmentDesc* pAttachments = nullptr;
    bool Resolves = false;
};
