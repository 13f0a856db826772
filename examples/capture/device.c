#include "device.h"

#include <dlfcn.h>
#include <string.h>

VkDevice device;
VkCommandBuffer buffer;

/* What we call of RenderDoc's table of functions, version 1.1.2; a program without a window has to say itself where a frame is. */
typedef struct {
    void *before[19];
    void (*start)(void *device, void *window);
    void *between;
    uint32_t (*end)(void *device, void *window);
} RenderDoc;

static RenderDoc *renderdoc;
static VkInstance instance;
static VkPhysicalDeviceMemoryProperties memories;
static VkQueue queue;
static VkCommandPool commands;
static VkFence done;
static PFN_vkSetDebugUtilsObjectNameEXT set_name;
static PFN_vkCmdBeginDebugUtilsLabelEXT begin_label;
static PFN_vkCmdEndDebugUtilsLabelEXT end_label;

static void open_instance(void) {
    VkApplicationInfo application = {VK_STRUCTURE_TYPE_APPLICATION_INFO, NULL, "forward", 1, NULL, 0, VK_API_VERSION_1_3};
    VkInstanceCreateInfo create = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, .pApplicationInfo = &application};
    const char *debug = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    VkExtensionProperties offered[64];
    uint32_t count = COUNT(offered);
    vkEnumerateInstanceExtensionProperties(NULL, &count, offered);
    while (count-- > 0)
        if (!strcmp(offered[count].extensionName, debug)) {
            create.enabledExtensionCount = 1;
            create.ppEnabledExtensionNames = &debug;
        }
    CHECK(vkCreateInstance(&create, NULL, &instance));
    if (create.enabledExtensionCount) {
        set_name = (PFN_vkSetDebugUtilsObjectNameEXT)vkGetInstanceProcAddr(instance, "vkSetDebugUtilsObjectNameEXT");
        begin_label = (PFN_vkCmdBeginDebugUtilsLabelEXT)vkGetInstanceProcAddr(instance, "vkCmdBeginDebugUtilsLabelEXT");
        end_label = (PFN_vkCmdEndDebugUtilsLabelEXT)vkGetInstanceProcAddr(instance, "vkCmdEndDebugUtilsLabelEXT");
    }
}

void open_device(void) {
    VkPhysicalDevice physical;
    VkPhysicalDeviceProperties properties;
    VkPhysicalDeviceFeatures offers;
    VkQueueFamilyProperties families[16];
    uint32_t count = 1, family = 0;
    open_instance();
    if (vkEnumeratePhysicalDevices(instance, &count, &physical) < 0 || !count) {
        fprintf(stderr, "forward: no Vulkan device\n");
        exit(1);
    }
    vkGetPhysicalDeviceProperties(physical, &properties);
    vkGetPhysicalDeviceMemoryProperties(physical, &memories);
    vkGetPhysicalDeviceFeatures(physical, &offers);
    count = COUNT(families);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
    while (family + 1 < count && !(families[family].queueFlags & VK_QUEUE_GRAPHICS_BIT))
        family++;
    printf("%s\n", properties.deviceName);

    VkDeviceQueueCreateInfo queues = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, NULL, 0, family, 1, &(float){1}};
    VkPhysicalDeviceVulkan13Features rendering = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES, .dynamicRendering = VK_TRUE
    };
    VkPhysicalDeviceFeatures features = {.sampleRateShading = offers.sampleRateShading};
    VkDeviceCreateInfo create = {VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &rendering, 0, 1, &queues, 0, NULL, 0, NULL, &features};
    CHECK(vkCreateDevice(physical, &create, NULL, &device));
    vkGetDeviceQueue(device, family, 0, &queue);

    VkCommandPoolCreateInfo pool = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, NULL, VK_COMMAND_POOL_CREATE_TRANSIENT_BIT, family};
    CHECK(vkCreateCommandPool(device, &pool, NULL, &commands));
    VkCommandBufferAllocateInfo primary = {
        VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, NULL, commands, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1
    };
    CHECK(vkAllocateCommandBuffers(device, &primary, &buffer));
    CHECK(vkCreateFence(device, &(VkFenceCreateInfo){VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, NULL, 0}, NULL, &done));
}

void close_device(void) {
    vkDestroyFence(device, done, NULL);
    vkDestroyCommandPool(device, commands, NULL);
    vkDestroyDevice(device, NULL);
    vkDestroyInstance(instance, NULL);
}

void named(VkObjectType type, uint64_t handle, const char *name) {
    VkDebugUtilsObjectNameInfoEXT info = {VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT, NULL, type, handle, name};
    if (set_name)
        CHECK(set_name(device, &info));
}

void begin_labelled(const char *name) {
    if (begin_label)
        begin_label(buffer, &(VkDebugUtilsLabelEXT){VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, NULL, name, {0}});
}

void end_labelled(void) {
    if (end_label)
        end_label(buffer);
}

VkDeviceMemory allocated(VkMemoryRequirements requirements, VkMemoryPropertyFlags wanted, VkMemoryPropertyFlags needed) {
    uint32_t type = UINT32_MAX;
    for (uint32_t i = memories.memoryTypeCount; i-- > 0;) {
        VkMemoryPropertyFlags has = memories.memoryTypes[i].propertyFlags;
        if (requirements.memoryTypeBits >> i & 1 && (has & needed) == needed && (type == UINT32_MAX || (has & wanted) == wanted))
            type = i;
    }
    VkMemoryAllocateInfo allocate = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, NULL, requirements.size, type};
    VkDeviceMemory memory;
    CHECK(vkAllocateMemory(device, &allocate, NULL, &memory));
    return memory;
}

void begin_capture(void) {
    int (*get)(int version, void **table);
    *(void **)&get = dlsym(dlopen(NULL, RTLD_NOW), "RENDERDOC_GetAPI");
    if (get && get(10102, (void **)&renderdoc))
        renderdoc->start(NULL, NULL);
}

void end_capture(void) {
    if (renderdoc)
        renderdoc->end(NULL, NULL);
}

void begin_commands(void) {
    VkCommandBufferBeginInfo once = {
        VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, NULL, VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, NULL
    };
    CHECK(vkResetCommandPool(device, commands, 0));
    CHECK(vkBeginCommandBuffer(buffer, &once));
}

void submit_commands(void) {
    VkSubmitInfo submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &buffer};
    CHECK(vkEndCommandBuffer(buffer));
    CHECK(vkQueueSubmit(queue, 1, &submit, done));
    CHECK(vkWaitForFences(device, 1, &done, VK_TRUE, UINT64_MAX));
    CHECK(vkResetFences(device, 1, &done));
}

void write_image(const char *path, VkImage image, VkExtent2D size) {
    VkBufferCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = 4 * size.width * size.height, .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT
    };
    VkBuffer pixels;
    VkMemoryRequirements requirements;
    CHECK(vkCreateBuffer(device, &create, NULL, &pixels));
    vkGetBufferMemoryRequirements(device, pixels, &requirements);
    VkDeviceMemory memory = allocated(requirements, 0, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    CHECK(vkBindBufferMemory(device, pixels, memory, 0));

    VkBufferImageCopy all = {0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {0, 0, 0}, {size.width, size.height, 1}};
    VkMemoryBarrier written = {VK_STRUCTURE_TYPE_MEMORY_BARRIER, NULL, VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_HOST_READ_BIT};
    begin_commands();
    vkCmdCopyImageToBuffer(buffer, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, pixels, 1, &all);
    vkCmdPipelineBarrier(buffer, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &written, 0, NULL, 0, NULL);
    submit_commands();

    void *mapped;
    CHECK(vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &mapped));
    FILE *file = fopen(path, "wb");
    if (!file) {
        perror(path);
        exit(1);
    }
    fprintf(file, "P6\n%u %u\n255\n", size.width, size.height);
    for (uint32_t pixel = 0; pixel < size.width * size.height; pixel++)
        fwrite((const unsigned char *)mapped + 4 * pixel, 1, 3, file);
    fclose(file);
    vkDestroyBuffer(device, pixels, NULL);
    vkFreeMemory(device, memory, NULL);
}
