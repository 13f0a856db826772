/* A portable C library's descriptors: sample counts and actions, no Vulkan anywhere. */
#include <stdbool.h>
#include <stdint.h>

typedef struct gfx_image { uint32_t id; } gfx_image;
typedef struct gfx_pipeline { uint32_t id; } gfx_pipeline;
typedef enum { GFX_LOADACTION_CLEAR, GFX_LOADACTION_LOAD, GFX_LOADACTION_DONTCARE } gfx_load_action;
typedef enum { GFX_STOREACTION_STORE, GFX_STOREACTION_DONTCARE, GFX_STOREACTION_RESOLVE } gfx_store_action;
typedef enum { GFX_RGBA8, GFX_DEPTH } gfx_pixel_format;

typedef struct gfx_image_desc {
    bool render_target;
    int width, height, sample_count;
    gfx_pixel_format pixel_format;
    const char *label;
} gfx_image_desc;

typedef struct gfx_attachment {
    gfx_image image;
    gfx_load_action load_op;
    gfx_store_action store_op;
    float clear[4];
    gfx_image resolve;
    bool cycle;
} gfx_attachment;

typedef struct gfx_pass_desc {
    gfx_attachment colors[4];
    gfx_attachment depth;
} gfx_pass_desc;

typedef struct gfx_pipeline_desc {
    int sample_count;
    bool alpha_to_coverage_enabled;
    gfx_pixel_format color, depth;
} gfx_pipeline_desc;

gfx_image gfx_make_image(const gfx_image_desc *desc);
gfx_pipeline gfx_make_pipeline(const gfx_pipeline_desc *desc);
void gfx_begin_pass(const gfx_pass_desc *desc);
void gfx_end_pass(void);
void gfx_draw(int first, int count, int instances);

static struct {
    gfx_image color, depth, resolved;
    gfx_pipeline scene, leaves;
} state;

void init(int width, int height) {
    gfx_image_desc desc = {
        .render_target = true,
        .width = width,
        .height = height,
        .sample_count = 4,
        .pixel_format = GFX_RGBA8,
        .label = "color",
    };
    state.color = gfx_make_image(&desc);
    desc.pixel_format = GFX_DEPTH;
    state.depth = gfx_make_image(&desc);
    desc.sample_count = 1;
    desc.pixel_format = GFX_RGBA8;
    state.resolved = gfx_make_image(&desc);
    state.scene = gfx_make_pipeline(&(gfx_pipeline_desc){.sample_count = 4, .color = GFX_RGBA8, .depth = GFX_DEPTH});
    state.leaves = gfx_make_pipeline(&(gfx_pipeline_desc){.sample_count = 1, .alpha_to_coverage_enabled = true});
}

void frame(void) {
    gfx_begin_pass(&(gfx_pass_desc){
        .colors[0] = {.image = state.color, .load_op = GFX_LOADACTION_CLEAR, .store_op = GFX_STOREACTION_STORE, .resolve = state.resolved},
        .depth = {.image = state.depth, .load_op = GFX_LOADACTION_CLEAR, .store_op = GFX_STOREACTION_STORE},
    });
    gfx_draw(0, 36, 100);
    gfx_end_pass();
}
