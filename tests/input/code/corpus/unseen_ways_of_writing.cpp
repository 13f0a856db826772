// The same two descriptions, written in every way that C++ has: what stands in the array in the end is right each time.
#include <vulkan/vulkan.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <vector>

static VkAttachmentDescription describe(VkSampleCountFlagBits samples, VkAttachmentLoadOp load, VkAttachmentStoreOp store) {
    VkAttachmentDescription d{};
    d.format = VK_FORMAT_R8G8B8A8_UNORM;
    d.samples = samples;
    d.loadOp = load;
    d.storeOp = store;
    d.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    return d;
}

static VkAttachmentDescription many() { return describe(VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_DONT_CARE); }
static VkAttachmentDescription one() { return describe(VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE); }
static VkAttachmentDescription kept() { return describe(VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_STORE); }

static VkRenderPass create(VkDevice device, const VkAttachmentDescription* attachments) {
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference resolve{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass{};
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

VkRenderPass by_plain(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[] = {many(), one()};
    return create(device, att);
}

VkRenderPass by_ptr_later(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    VkAttachmentDescription* p;
    p = &att[0];
    *p = many();
    p = att+1;
    *p = one();
    return create(device, att);
}

VkRenderPass by_ref_to_elem(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    auto& a = att[0];
    auto& b = att[1];
    a = many();
    b = one();
    return create(device, att);
}

VkRenderPass by_cond_ptr(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    auto* p = cond?&att[0]:&att[1];
    *p = many();
    att[0] = many();
    att[1] = one();
    return create(device, att);
}

VkRenderPass by_std_fill(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2] = {kept(), kept()};
    std::fill(att, att+2, many());
    att[1] = one();
    return create(device, att);
}

VkRenderPass by_copy_n(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription src[2] = {many(), one()}, att[2];
    std::copy_n(src, 2, att);
    return create(device, att);
}

VkRenderPass by_vector_assign(VkDevice device, bool cond) {
    (void)cond;
    std::vector<VkAttachmentDescription> att;
    att.assign(2, one());
    att[0] = many();
    return create(device, att.data());
}

VkRenderPass by_vector_init_list(VkDevice device, bool cond) {
    (void)cond;
    std::vector<VkAttachmentDescription> att(2);
    att = {many(), one()};
    return create(device, att.data());
}

VkRenderPass by_vector_swap(VkDevice device, bool cond) {
    (void)cond;
    std::vector<VkAttachmentDescription> att{one(), many()}, b{many(), one()};
    att.swap(b);
    return create(device, att.data());
}

VkRenderPass by_array_fill(VkDevice device, bool cond) {
    (void)cond;
    std::array<VkAttachmentDescription, 2> att;
    att.fill(one());
    att[0] = many();
    return create(device, att.data());
}

VkRenderPass by_array_get(VkDevice device, bool cond) {
    (void)cond;
    std::array<VkAttachmentDescription, 2> att{};
    std::get<0>(att) = many();
    std::get<1>(att) = one();
    return create(device, att.data());
}

VkRenderPass by_array_at(VkDevice device, bool cond) {
    (void)cond;
    std::array<VkAttachmentDescription, 2> att{};
    att.at(0) = many();
    att.at(1) = one();
    return create(device, att.data());
}

VkRenderPass by_array_front_back(VkDevice device, bool cond) {
    (void)cond;
    std::array<VkAttachmentDescription, 2> att{};
    att.front() = many();
    att.back() = one();
    return create(device, att.data());
}

VkRenderPass by_unique_ptr_array(VkDevice device, bool cond) {
    (void)cond;
    auto att = std::make_unique<VkAttachmentDescription[]>(2);
    att[0] = many();
    att[1] = one();
    return create(device, att.get());
}

VkRenderPass by_new_array(VkDevice device, bool cond) {
    (void)cond;
    auto* att = new VkAttachmentDescription[2]();
    att[0] = many();
    att[1] = one();
    return create(device, att);
}

VkRenderPass by_map(VkDevice device, bool cond) {
    (void)cond;
    std::map<int, VkAttachmentDescription> m;
    m[0] = many();
    m[1] = one();
    VkAttachmentDescription att[] = {m[0], m[1]};
    return create(device, att);
}

VkRenderPass by_map_at(VkDevice device, bool cond) {
    (void)cond;
    std::map<int, VkAttachmentDescription> m;
    m[1] = one();
    m[0] = many();
    std::vector<VkAttachmentDescription> att;
    for (auto& [k, v]: m) att.push_back(v);
    return create(device, att.data());
}

VkRenderPass by_optional(VkDevice device, bool cond) {
    (void)cond;
    std::optional<VkAttachmentDescription> o;
    o = many();
    o->storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    VkAttachmentDescription att[] = {*o, one()};
    return create(device, att);
}

VkRenderPass by_ternary_struct(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[] = {cond?many():many(), one()};
    return create(device, att);
}

VkRenderPass by_lambda_ref_capture(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    att[0] = kept();
    att[1] = one();
    auto fix = [&](int i){att[i].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;};
    fix(0);
    return create(device, att);
}

VkRenderPass by_lambda_this_later(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    att[0] = kept();
    att[1] = one();
    std::function<void()> fix = [&]{att[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;};
    fix();
    return create(device, att);
}

VkRenderPass by_member_ptr(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    att[0] = kept();
    att[1] = one();
    auto m = &VkAttachmentDescription::storeOp;
    att[0].*m = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    return create(device, att);
}

VkRenderPass by_memcpy_one(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    const auto a = many();
    att[0] = kept();
    att[1] = one();
    memcpy(&att[0], &a, sizeof a);
    return create(device, att);
}

VkRenderPass by_memset_one(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2] = {many(), kept()};
    memset(&att[1], 0, sizeof att[1]);
    att[1] = one();
    return create(device, att);
}

VkRenderPass by_operator(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    att[0] = many();
    att[1] = one();
    VkImageUsageFlags u = 0;
    u|=VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    return create(device, att);
}

VkRenderPass by_while_index(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    int i = 0;
    while (i<2) { att[i] = i == 0?many():one();
    ++i;
    }
    return create(device, att);
}

VkRenderPass by_reverse_loop(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    for (int i = 1;i >= 0;--i) { att[i] = i?one():many();
    }
    return create(device, att);
}

VkRenderPass by_switch_idx(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    for (int i = 0;i<2;++i) switch (i) { case 0: att[i] = many();
    break;
    case 1: att[i] = one();
    break;
    }
    return create(device, att);
}

VkAttachmentDescription stranger(int);
VkRenderPass by_extern_fn_ret(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[] = {stranger(0), stranger(1)};
    att[0].samples = VK_SAMPLE_COUNT_4_BIT;
    att[1].samples = VK_SAMPLE_COUNT_1_BIT;
    return create(device, att);
}

void fill_extern_fn_ref(VkAttachmentDescription&);
VkRenderPass by_extern_fn_ref(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    fill_extern_fn_ref(att[0]);
    fill_extern_fn_ref(att[1]);
    att[0].samples = VK_SAMPLE_COUNT_4_BIT;
    att[1].samples = VK_SAMPLE_COUNT_1_BIT;
    return create(device, att);
}

void fill_extern_fn_arr(VkAttachmentDescription (&)[2]);
VkRenderPass by_extern_fn_arr(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    fill_extern_fn_arr(att);
    att[0].samples = VK_SAMPLE_COUNT_4_BIT;
    att[1].samples = VK_SAMPLE_COUNT_1_BIT;
    return create(device, att);
}

void fill_extern_fn_ptr(VkAttachmentDescription*, int);
VkRenderPass by_extern_fn_ptr(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    fill_extern_fn_ptr(att, 2);
    att[0].samples = VK_SAMPLE_COUNT_4_BIT;
    att[1].samples = VK_SAMPLE_COUNT_1_BIT;
    return create(device, att);
}

#define FILL_BOTH(x) do { x[0]=many(); x[1]=one(); } while(0)
VkRenderPass by_macro_fill(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    FILL_BOTH(att);
    att[0].samples = VK_SAMPLE_COUNT_4_BIT;
    att[1].samples = VK_SAMPLE_COUNT_1_BIT;
    return create(device, att);
}

#define SET_ONE(i,n,l,s) att[i].format=VK_FORMAT_R8G8B8A8_UNORM; att[i].samples=VK_SAMPLE_COUNT_##n##_BIT; att[i].loadOp=VK_ATTACHMENT_LOAD_OP_##l; att[i].storeOp=VK_ATTACHMENT_STORE_OP_##s;
VkRenderPass by_macro_set(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    SET_ONE(0, 4, CLEAR, DONT_CARE) SET_ONE(1, 1, DONT_CARE, STORE)
    return create(device, att);
}

VkRenderPass by_struct_in_struct(VkDevice device, bool cond) {
    (void)cond;
    struct { VkAttachmentDescription a[2];
    } w{};
    w.a[0] = many();
    w.a[1] = one();
    return create(device, w.a);
}

VkRenderPass by_nested_ptr(VkDevice device, bool cond) {
    (void)cond;
    struct W { VkAttachmentDescription a[2];
    };
    W w{};
    W* q = &w;
    q->a[0] = many();
    q->a[1] = one();
    return create(device, w.a);
}

VkRenderPass by_static_local(VkDevice device, bool cond) {
    (void)cond;
    static VkAttachmentDescription att[2];
    if (!att[0].samples) { att[0] = many();
    att[1] = one();
    }
    return create(device, att);
}

VkRenderPass by_placement(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    new (&att[0]) VkAttachmentDescription(many());
    new (&att[1]) VkAttachmentDescription(one());
    return create(device, att);
}

VkRenderPass by_union(VkDevice device, bool cond) {
    (void)cond;
    union U { VkAttachmentDescription a[2];
    int x;
    } u;
    u.a[0] = many();
    u.a[1] = one();
    return create(device, u.a);
}

VkRenderPass by_span(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    std::span<VkAttachmentDescription> sp(att);
    sp[0] = many();
    sp[1] = one();
    return create(device, att);
}

VkRenderPass by_iter(VkDevice device, bool cond) {
    (void)cond;
    std::vector<VkAttachmentDescription> att(2);
    for (auto it = att.begin();
    it != att.end();
    ++it) *it = it == att.begin()?many():one();
    return create(device, att.data());
}

VkRenderPass by_back_inserter(VkDevice device, bool cond) {
    (void)cond;
    std::vector<VkAttachmentDescription> src{many(), one()}, att;
    std::copy(src.begin(), src.end(), std::back_inserter(att));
    return create(device, att.data());
}

VkRenderPass by_transform(VkDevice device, bool cond) {
    (void)cond;
    std::vector<int> k{4, 1};
    std::vector<VkAttachmentDescription> att(2);
    std::transform(k.begin(), k.end(), att.begin(), [](int s){ return s>1?many():one();
    });
    return create(device, att.data());
}

VkRenderPass by_indexed_enum(VkDevice device, bool cond) {
    (void)cond;
    enum { COLOR, RES };
    VkAttachmentDescription att[2]{};
    att[RES] = one();
    att[COLOR] = many();
    return create(device, att);
}

VkRenderPass by_comma(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    att[0] = many(), att[1] = one();
    return create(device, att);
}

VkRenderPass by_chain_assign(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    att[0] = att[1] = one();
    att[0] = many();
    return create(device, att);
}

VkRenderPass by_const_cast(VkDevice device, bool cond) {
    (void)cond;
    const VkAttachmentDescription att[2] = {kept(), one()};
    const_cast<VkAttachmentDescription&>(att[0]).storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    return create(device, att);
}

VkRenderPass by_goto(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    att[1] = one();
    att[0] = kept();
    if (cond) goto out;
    out: att[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    return create(device, att);
}

VkAttachmentDescription& element(VkAttachmentDescription* a, int i){ return a[i]; }
VkRenderPass by_nested_fn_ret_ref(VkDevice device, bool cond) {
    (void)cond;
    VkAttachmentDescription att[2]{};
    element(att, 0) = many();
    element(att, 1) = one();
    return create(device, att);
}

struct List { VkAttachmentDescription v[2]{}; VkAttachmentDescription& operator[](int i){return v[i];} VkAttachmentDescription* data(){return v;} };
VkRenderPass by_class_op(VkDevice device, bool cond) {
    (void)cond;
    List att;
    att[0] = many();
    att[1] = one();
    return create(device, att.data());
}

VkRenderPass by_front_reference(VkDevice device, bool cond) {
    (void)cond;
    std::array<VkAttachmentDescription, 2> att{kept(), one()};
    auto& first = att.front();
    first.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    return create(device, att.data());
}

VkRenderPass by_back_reference(VkDevice device, bool cond) {
    (void)cond;
    std::vector<VkAttachmentDescription> att{many(), kept()};
    VkAttachmentDescription& last = att.back();
    last = one();
    return create(device, att.data());
}

VkRenderPass by_at_reference(VkDevice device, int which) {
    std::vector<VkAttachmentDescription> att{kept(), one()};
    auto& chosen = att.at(which);
    chosen.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    return create(device, att.data());
}

VkRenderPass by_reverse_iterator(VkDevice device, bool cond) {
    (void)cond;
    std::vector<VkAttachmentDescription> att{one(), kept()};
    auto last = att.rbegin();
    last->storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    std::swap(att[0], att[1]);
    return create(device, att.data());
}
