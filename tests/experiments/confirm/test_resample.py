"""Plans of another size, and with another sample count."""

from __future__ import annotations

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from msaa_lint.experiments.confirm import parts
from msaa_lint.experiments.confirm.parts import (
    NONE,
    Attachment,
    Framebuffer,
    Image,
    Pass,
    PassCommand,
    Pipeline,
    Plan,
    Reference,
    RenderTarget,
    Step,
    Subpass,
)
from msaa_lint.experiments.confirm.resample import MAX_IMAGE, pictured, resampled, resized
from tests.experiments.confirm.frames import planned

COLOR, DEPTH = 2, 3
"""VkImageLayouts."""


def image(
    width: int = 64, height: int = 64, samples: int = 1, name: str = "i", type: int = 1
) -> Image:
    return Image(
        name, 37, samples, 0x10, width, height, 1, 1, 1, type, 0, 0, False, parts.COLOR, "UNORM", 4
    )


def attachment(
    samples: int = 1, load: int = 2, store: int = 1, initial: int = 0, final: int = COLOR
) -> Attachment:
    return Attachment(37, samples, 0, load, store, 2, 1, initial, final)


SIZES = st.tuples(st.integers(1, 4000), st.integers(1, 4000))


@st.composite
def plans(draw: st.DrawFn) -> Plan:
    """Passes of many sizes, within images that are as large or larger, drawn to on areas within
    them.
    """
    images, passes, steps = [], [], []
    for number in range(draw(st.integers(1, 3))):
        width, height = draw(SIZES)
        more = draw(st.tuples(st.integers(0, 100), st.integers(0, 100)))
        images.append(image(width + more[0], height + more[1]))
        passes.append(
            Pass(
                "p",
                "p",
                parts.RENDER_PASS,
                2,
                framebuffers=(Framebuffer((number,), width, height, 1),),
            )
        )
        left, top = draw(st.integers(0, width - 1)), draw(st.integers(0, height - 1))
        area = (left, top, draw(st.integers(1, width - left)), draw(st.integers(1, height - top)))
        steps.append(Step("begin", number, area=area))
        steps.append(Step("present", number, source=number, target=number))
    return Plan("f", tuple(images), tuple(passes), tuple(steps))


def fits(made: Plan) -> None:
    """Areas lie within framebuffers, framebuffers within their images, and nothing is empty."""
    for step in made.steps:
        if step.kind != "begin":
            assert step.area == ()
            continue
        framebuffer = made.passes[step.number].framebuffers[step.framebuffer]
        x, y, width, height = step.area
        assert x >= 0 and y >= 0 and width >= 1 and height >= 1
        assert x + width <= framebuffer.width and y + height <= framebuffer.height
        own = made.images[framebuffer.images[0]]
        assert 1 <= framebuffer.width <= own.width and 1 <= framebuffer.height <= own.height


@example(Plan("f", (image(3, 3),), (Pass("p", "p", parts.RENDER_PASS, 2,
framebuffers=(Framebuffer((0,), 3, 3, 1),)),),
              (Step("begin", 0, area=(2, 2, 1, 1)),)), (1, 2))  # fmt: skip
@given(plans(), SIZES)
def test_what_is_resized_fits(plan: Plan, size: tuple[int, int]) -> None:
    made = resized(plan, size)
    fits(made)
    assert max(each.framebuffers[0].width for each in made.passes) == size[0]
    assert max(each.framebuffers[0].height for each in made.passes) == size[1]
    assert made._replace(images=plan.images, passes=plan.passes, steps=plan.steps) == plan


@given(plans(), st.integers(1, 600))
def test_a_picture_fits(plan: Plan, largest: int) -> None:
    made = pictured(plan, largest)
    fits(made)
    before, after = (
        max(max(each.width, each.height) for each in one.images) for one in (plan, made)
    )
    assert after == min(before, largest)
    if before <= largest:
        assert made is plan


@given(plans(), SIZES)
def test_areas_are_cut_in_proportion(plan: Plan, size: tuple[int, int]) -> None:
    made = resized(plan, size)
    widest = max(each.framebuffers[0].width for each in plan.passes)
    for before, after in zip(plan.steps, made.steps, strict=True):
        if before.area:
            # Edges are rounded down, so that areas side by side stay side by side; what would be
            # empty has one texel. A framebuffer's edge is rounded as well, and an area ends there.
            assert abs(after.area[0] - before.area[0] * size[0] / widest) < 2
            assert abs(after.area[2] - before.area[2] * size[0] / widest) < 2


@given(plans(), SIZES)
def test_areas_that_are_whole_stay_whole(plan: Plan, size: tuple[int, int]) -> None:
    steps = [
        step._replace(area=(0, 0, *plan.passes[step.number].framebuffers[0][1:3]))
        for step in plan.steps
    ]
    made = resized(plan._replace(steps=tuple(steps)), size)
    for step in made.steps:
        assert step.area == (0, 0, *made.passes[step.number].framebuffers[0][1:3])


def test_proportions_are_kept() -> None:
    framebuffers = (Framebuffer((0,), 1920, 1080, 1), Framebuffer((1,), 960, 540, 2))
    plan = Plan(
        "f",
        (image(1920, 1080), image(960, 540), image(3, 1)),
        tuple(Pass("p", "p", parts.RENDER_PASS, 2, framebuffers=(each,)) for each in framebuffers),
        (
            Step("begin", 0, area=(480, 270, 960, 540)),
            Step("begin", 1, area=(0, 0, 960, 540)),
            Step("copy", 1, source=0, target=1),
        ),
    )
    made = pictured(plan)
    assert MAX_IMAGE == 512
    assert [(each.width, each.height) for each in made.images] == [(512, 288), (256, 144), (1, 1)]
    assert [each.framebuffers[0] for each in made.passes] == [
        Framebuffer((0,), 512, 288, 1),
        Framebuffer((1,), 256, 144, 2),
    ]
    assert [step.area for step in made.steps] == [(128, 72, 256, 144), (0, 0, 256, 144), ()]
    assert pictured(made) is made
    turned = resized(plan, (100, 200))
    assert [(each.width, each.height) for each in turned.images] == [(100, 200), (50, 100), (1, 1)]


def test_a_line_stays_one() -> None:
    plan = Plan("f", (image(1024, 1, type=0), image(1024, 1024)))
    assert [(each.width, each.height) for each in pictured(plan).images] == [(512, 1), (512, 512)]
    assert [(each.width, each.height) for each in resized(plan, (2048, 4096)).images] == [
        (2048, 1),
        (2048, 4096),
    ]


def test_without_passes_the_largest_image_counts() -> None:
    plan = Plan("f", (image(100, 50), image(50, 200)))
    assert [(each.width, each.height) for each in resized(plan, (10, 20)).images] == [
        (10, 5),
        (5, 20),
    ]
    assert [
        (each.width, each.height)
        for each in resized(Plan("f", (image(100, 200),)), (10, 10)).images
    ] == [(10, 10)]
    assert resized(Plan(), (10, 20)) == Plan()
    assert pictured(Plan()) == Plan()


# Counts


@given(
    st.lists(st.sampled_from([1, 2, 4, 8, 16]), min_size=1, max_size=4),
    st.sampled_from([1, 2, 4, 8]),
)
def test_every_count_above_one_is_the_one_that_is_asked_for(
    counts: list[int], samples: int
) -> None:
    each = Pass(
        "p", "p", parts.RENDER_PASS, 2, attachments=tuple(attachment(count) for count in counts),
        pipelines=tuple(Pipeline("x", 0, count) for count in counts),
        subpasses=(Subpass(colors=(Reference(0, COLOR),)),),
    )  # fmt: skip
    plan = Plan("f", tuple(image(samples=count) for count in counts), (each,))
    made = resampled(plan, samples)
    expected = [samples if count > 1 else 1 for count in counts]
    assert [one.samples for one in made.images] == expected
    assert [one.samples for one in made.passes[0].attachments] == expected
    assert [one.samples for one in made.passes[0].pipelines] == expected
    assert resampled(made, samples) == made
    if samples > 1:
        assert resampled(plan, samples).passes[0].subpasses == each.subpasses


def test_resolves_stay_where_there_are_samples() -> None:
    subpass = Subpass(
        colors=(Reference(0, COLOR),), resolves=(Reference(1, COLOR),), single_sampled=2
    )
    each = Pass(
        "p",
        "p",
        parts.RENDER_PASS,
        2,
        attachments=(attachment(4), attachment()),
        subpasses=(subpass,),
        single_sampled=2,
    )
    made = resampled(Plan("f", passes=(each,), steps=(Step("resolve", 0, source=0, target=1),)), 8)
    assert made.passes[0].subpasses == (subpass._replace(single_sampled=8),)
    assert made.passes[0].single_sampled == 8
    assert made.steps[0].kind == "resolve"


def test_one_sample_draws_to_the_target() -> None:
    first = Subpass(
        colors=(Reference(0, COLOR), Reference(1, COLOR), Reference(NONE)),
        resolves=(Reference(3, COLOR), Reference(NONE), Reference(NONE)),
        depth_stencil=(Reference(2, DEPTH),), depth_resolve=(Reference(4, DEPTH),), depth_mode=1,
        stencil_mode=0, preserves=(5,),
    )  # fmt: skip
    second = Subpass(
        inputs=(Reference(0, 5, 1),), colors=(Reference(1, COLOR),), preserves=(2, 4, 5)
    )
    each = Pass(
        "p", "p", parts.RENDER_PASS, 2,
        attachments=(
            attachment(4, load=0, initial=COLOR), attachment(4, load=1), attachment(4, load=1,
            final=DEPTH)._replace(stencil_load=0),
            attachment(load=2, store=0, final=5), attachment(load=2, store=1), attachment(4),
        ),
        subpasses=(first, second),
    )  # fmt: skip
    made = resampled(Plan("f", passes=(each,)), 1).passes[0]
    assert made.attachments == (
        attachment(1, load=0, initial=COLOR), attachment(1, load=1), attachment(1, load=1,
        final=DEPTH)._replace(stencil_load=0),
        # What is drawn to instead is loaded as its source, kept, and left as before.
        attachment(1, load=0, store=0, initial=COLOR, final=5),
        attachment(1, load=1, store=0)._replace(stencil_load=0),
        attachment(1),
    )  # fmt: skip
    assert made.subpasses == (
        Subpass(
            colors=(Reference(3, COLOR), Reference(1, COLOR), Reference(NONE)),
            depth_stencil=(Reference(4, DEPTH),),
            preserves=(5,),
        ),
        Subpass(inputs=(Reference(3, 5, 1),), colors=(Reference(1, COLOR),), preserves=(4, 5)),
    )


def test_what_a_subpass_uses_it_does_not_preserve() -> None:
    """VUID-VkSubpassDescription2-pPreserveAttachments-03074."""
    first = Subpass(colors=(Reference(0, COLOR),), resolves=(Reference(1, COLOR),))
    second = Subpass(inputs=(Reference(1, 5, 1),), colors=(Reference(2, COLOR),), preserves=(0,))
    third = Subpass(colors=(Reference(2, COLOR),), preserves=(0, 1))
    each = Pass(
        "p",
        "p",
        parts.RENDER_PASS,
        2,
        attachments=(attachment(4), attachment(), attachment()),
        subpasses=(first, second, third),
    )
    made = resampled(Plan("f", passes=(each,)), 1).passes[0]
    assert [subpass.preserves for subpass in made.subpasses] == [(), (), (1,)]


def test_a_depth_resolve_of_no_aspect_is_none() -> None:
    subpass = Subpass(depth_stencil=(Reference(0, DEPTH),), depth_resolve=(Reference(1, DEPTH),))
    each = Pass(
        "p",
        "p",
        parts.RENDER_PASS,
        2,
        attachments=(attachment(4), attachment()),
        subpasses=(subpass,),
    )
    made = resampled(Plan("f", passes=(each,)), 1).passes[0]
    assert made.subpasses == (Subpass(depth_stencil=(Reference(0, DEPTH),)),)
    assert made.attachments == (attachment(1), attachment())


def test_one_sample_renders_to_the_target() -> None:
    rendered = (
        RenderTarget("color", 0, COLOR, 2, 1, 5, load=1, store=1),
        RenderTarget("color", 2, COLOR, 0, NONE, load=0, store=0),
        RenderTarget("color"),
        RenderTarget("depth", 3, DEPTH, 0, 4, DEPTH, load=1, store=1),
    )
    each = Pass("p", "p", parts.RENDERING, 0, rendered=rendered)
    assert resampled(Plan("f", passes=(each,)), 1).passes[0].rendered == (
        RenderTarget("color", 1, 5, 0, NONE, 5, load=1, store=0),
        RenderTarget("color", 2, COLOR, 0, NONE, load=0, store=0),
        RenderTarget("color"),
        RenderTarget("depth", 3, DEPTH, 0, 4, DEPTH, load=1, store=1),
    )
    assert resampled(Plan("f", passes=(each,)), 2).passes[0].rendered == rendered


def drawn(number: int, *images: int) -> Pass:
    rendered = tuple(RenderTarget("color", each, COLOR) for each in images)
    return Pass(
        f"p{number}",
        "p",
        parts.RENDERING,
        0,
        rendered=rendered,
        framebuffers=(Framebuffer(images, 64, 64, 1),),
        images=images,
    )


def test_one_sample_draws_to_what_a_command_resolves_to() -> None:
    steps = (
        Step("begin", 0, area=(0, 0, 64, 64), inner=(PassCommand("draw", 0, 0),)),
        Step("barrier", 0, masks=(1, 2, 3, 4), layouts=((1, 0, 7), (2, 0, 7))),
        Step("resolve", 0, source=0, target=1),
        Step("blit", 0, source=1, target=2),
    )
    images = (
        image(samples=4, name="samples")._replace(usage=0x51),
        image(name="picture")._replace(usage=6),
        image(),
    )
    made = resampled(Plan("f", images, (drawn(0, 0),), steps), 1)
    # The layouts of the image are not those of a transfer any more, so what the barrier was for has
    # one between all commands.
    barrier = Step("barrier", 0, masks=(0x10000, 0x10000, 0x10000, 0x18000), layouts=((2, 0, 7),))
    assert made.steps == (steps[0], barrier, steps[3])
    assert [target.image for target in made.passes[0].rendered] == [1]
    assert (made.passes[0].framebuffers[0].images, made.passes[0].images) == ((1,), (1,))
    assert made.images[1].usage == 0x17
    assert resampled(Plan("f", images, (drawn(0, 0),), steps), 2).steps == steps


@pytest.mark.parametrize(
    ("first", "last"),
    [
        (Step("clear", 0, target=1), None),
        (None, Step("copyOut", 0, source=0)),
        (None, Step("resolve", 0, source=0, target=2)),
        (None, Step("begin", 1, area=(0, 0, 64, 64))),
    ],
)
def test_one_sample_copies_what_is_used_otherwise(first: Step | None, last: Step | None) -> None:
    """The target holds something before, the source is read, resolved to another image, or drawn to
    afterward.
    """
    between = (Step("begin", 0, area=(0, 0, 64, 64)), Step("resolve", 0, source=0, target=1))
    steps = tuple(step for step in (first, *between, last) if step is not None)
    plan = Plan("f", (image(samples=4), image(), image()), (drawn(0, 0), drawn(1, 0)), steps)
    made = resampled(plan, 1)
    assert [step.kind for step in made.steps] == [
        "copy" if step.kind == "resolve" else step.kind for step in steps
    ]
    assert made.passes[0].rendered == plan.passes[0].rendered


def test_one_sample_copies_between_formats_and_sizes() -> None:
    step = Step("resolve", 0, source=0, target=1)
    for other in (image(32, 64), image()._replace(format=44)):
        assert resampled(Plan("f", (image(samples=4), other), steps=(step,)), 1).steps == (
            step._replace(kind="copy"),
        )


SINGLE = """\
images: {c: {format: R8G8B8A8_UNORM, samples: 1, flags: [MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_EXT]}}
renderPasses:
  p:
    attachments: {c: {image: c, loadOp: CLEAR, storeOp: STORE}}
    subpasses: [{colorAttachments: [c], multisampledRenderToSingleSampled: {rasterizationSamples: 4}}]
commands:
  - beginRendering:
      colorAttachments: [{image: c, loadOp: CLEAR, storeOp: STORE}]
      multisampledRenderToSingleSampled: {multisampledRenderToSingleSampledEnable: true, rasterizationSamples: 4}
  - endRendering
"""


@pytest.mark.parametrize(("samples", "counts"), [(8, 8), (2, 2), (1, 0)])
def test_one_sample_is_not_rendered_to_one(samples: int, counts: int) -> None:
    """VUID-VkMultisampledRenderToSingleSampledInfoEXT-rasterizationSamples-06878: never with one
    sample.
    """
    made = planned(SINGLE, samples=samples)
    assert [subpass.single_sampled for subpass in made.passes[0].subpasses] == [counts]
    assert made.passes[1].single_sampled == counts
    assert {pipeline.samples for each in made.passes for pipeline in each.pipelines} == {samples}


@pytest.mark.parametrize("samples", [1, 2, 8])
def test_a_dynamic_count_is_the_one_that_is_asked_for(samples: int) -> None:
    made = planned(
        """\
images: {c: {format: R8G8B8A8_UNORM, samples: 4}}
renderPasses:
  p: {attachments: {c: {image: c, loadOp: CLEAR, storeOp: STORE}}, subpasses: [{colorAttachments: [c]}]}
pipelines: {x: {renderPass: p, dynamicState: [RASTERIZATION_SAMPLES_EXT]}}
commands: [{beginRenderPass: {renderPass: p}}, {setRasterizationSamples: 4}, {draw: {pipeline: x}}, endRenderPass]
""",
        samples=samples,
    )
    assert [inner.value for inner in made.steps[0].inner if inner.kind == "samples"] == [samples]


def test_an_image_has_no_more_levels_than_its_size_allows() -> None:
    """VUID-VkImageCreateInfo-mipLevels-00958."""
    made = pictured(
        Plan("f", (image(2048, 1024)._replace(levels=12), image(512, 512)._replace(levels=4)))
    )
    assert [(each.width, each.height, each.levels) for each in made.images] == [
        (512, 256, 10),
        (128, 128, 4),
    ]
    # What has too many as it is described has them still.
    many = pictured(Plan("f", (image(2048, 1024)._replace(levels=13),)))
    assert many.images[0].levels > 10


def test_a_cube_stays_square() -> None:
    """VUID-VkImageCreateInfo-flags-08866."""
    cube = image(64, 64)._replace(flags=0x10, layers=6)
    each = Pass("p", "p", parts.RENDER_PASS, 2, framebuffers=(Framebuffer((0,), 64, 64, 1),))
    (made,) = resized(Plan("f", (cube,), (each,)), (32, 16)).images
    assert made.width == made.height >= 32
