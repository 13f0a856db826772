#ifndef COMMON_H
#define COMMON_H

#include <string.h>
#include <vulkan/vulkan.h>

#if defined(_WIN32)
#define R_API __declspec(dllexport)
#else
#define R_API __attribute__((visibility("default")))
#endif

#define ZEROED_STRUCT(type, name) \
    type name;                    \
    memset(&name, 0, sizeof(type))

#define ATTACHMENT(index, count, op)                                      \
    attachments[index].format = format;                                   \
    attachments[index].samples = VK_SAMPLE_COUNT_##count##_BIT;           \
    attachments[index].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;              \
    attachments[index].storeOp = VK_ATTACHMENT_STORE_OP_##op;             \
    attachments[index].finalLayout = VK_IMAGE_LAYOUT_GENERAL

#define NUM(a) (int)(sizeof(a) / sizeof(*(a)))
#define R_LEGACY_PATH 0

#endif
