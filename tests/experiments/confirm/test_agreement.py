"""The layer's messages and our findings, put side by side."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Mapping, Sequence
from functools import cache

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.experiments.confirm.agreement import (
    BOTH,
    EXPLAINED,
    NO_CHECK,
    NOISE,
    OURS,
    SILENT,
    THEIRS,
    agreement,
)
from msaa_lint.experiments.confirm.explanations import CONSEQUENCES, EXPLANATIONS, Noise
from msaa_lint.experiments.confirm.explanations import NOISE as LEFT_OUT
from msaa_lint.experiments.confirm.families import (
    FAMILIES,
    RENDER_PASS,
    RENDER_PASS_2,
    RENDERING,
    Family,
)
from msaa_lint.experiments.confirm.layer_scope import LayerScope, layer_scope, pass_kind
from msaa_lint.experiments.confirm.messages import Message, bare, classify, sentence
from msaa_lint.experiments.confirm.outcome import AgreementRow
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.linter.engine import Engine
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.results import FileResult
from msaa_lint.linter.rules.condition import check
from msaa_lint.linter.rules.registry import load
from tests.paths import ROOT

ENGINE = Engine(load([]))
RULES = {rule.name: rule for rule in ENGINE.registry.rules}
BY_NAME = {family.name: family for family in FAMILIES}

WITHOUT_NUMBER = re.compile(r"-\d{5}$")


def references(rule: str) -> list[str]:
    """The ids of the layer that a page refers to."""
    found = [reference.split(" ")[0] for reference in RULES[rule].references]
    return [each for each in found if each.startswith(("VUID-", "BestPractices-"))]


ASIDE = {
    (
        "attachment-untouched",
        "BestPractices-vkCmdEndRenderPass-redundant-attachment-on-tile",
    ),  # confirm draws a scene of its own
    (
        "attachment-untouched",
        "VUID-VkRenderPassFragmentDensityMapCreateInfoEXT-fragmentDensityMapAttachment-02548",
    ),  # why one is excused
    (
        "clear-command-instead-of-load-op",
        "BestPractices-AMD-ClearAttachment-ClearImage-color,",
    ),  # AMD's, for reasons of its own
    (
        "clear-value-without-clear",
        "BestPractices-ClearValueCountHigherThanAttachmentCount",
    ),  # confirm gives values of its own
    (
        "clear-value-without-clear",
        "VUID-VkRenderPassBeginInfo-clearValueCount-00902",
    ),  # what must hold besides
    (
        "depth-resolve-unread",
        "VUID-VkSubpassDescriptionDepthStencilResolve-pDepthStencilResolveAttachment-03178",
    ),  # likewise
    (
        "multisampled-image-not-transient",
        "VUID-VkImageCreateInfo-usage-00963",
    ),  # why some images are excused
    (
        "sample-shading-feature-missing",
        "VUID-VkShaderModuleCreateInfo-pCode-08740",
    ),  # of this capability only: its text tells
    (
        "sample-shading-ineffective",
        "VUID-VkPipelineMultisampleStateCreateInfo-sampleShadingEnable-00784",
    ),  # what must hold besides
    (
        "resolve-read-unsynchronised",
        "VUID-VkSubpassDependency-srcAccessMask-00868",
    ),  # what must hold besides
    # How a program comes to its count, of which no device is asked.
    ("source-sample-count-maximum", "BestPractices-Arm-vkCreateImage-too-large-sample-count"),
    ("source-sample-count-maximum", "BestPractices-IMG-vkCreateImage-too-large-sample-count"),
    ("source-sample-masks-compared", "VUID-VkImageCreateInfo-samples-02258"),
    ("integer-multisampled-target", "VUID-VkRenderingAttachmentInfo-imageView-06130"),
    ("source-stencil-counts-ignored", "VUID-VkImageCreateInfo-samples-02258"),
    (
        "multisampling-unused",
        "VUID-VkGraphicsPipelineCreateInfo-multisampledRenderToSingleSampled-06853",
    ),  # what must hold besides
}
"""Pages that refer to an id that says something else than their rule."""

REFERENCES = sorted((rule, id) for rule in RULES for id in references(rule))


@pytest.mark.parametrize(("rule", "id"), REFERENCES, ids=lambda value: value)
def test_what_a_page_refers_to_is_in_a_family_that_names_its_rule(rule: str, id: str) -> None:
    family = classify(id)
    named = isinstance(family, Family) and rule in family.rules
    assert named != ((rule, id) in ASIDE)


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_the_pages_of_a_familys_rules_refer_to_it(family: Family) -> None:
    if family.scope.instead and family.name != "copy-samples":
        # Ours answers to another matter.
        return
    for rule in family.rules:
        assert family in [classify(id) for id in references(rule)], rule


def test_names_are_of_one_thing_each() -> None:
    assert len(BY_NAME) == len(FAMILIES)
    ids = [id for each in (*FAMILIES, *LEFT_OUT) for id in each.ids]
    assert len(set(ids)) == len(ids)
    for each in (*FAMILIES, *LEFT_OUT):
        for id in each.ids:
            known = f"VUID-X-y-{id}" if id.isdecimal() else f"BestPractices-{id}"
            assert classify(known) is each, f"{id} is {classify(known)}"


def test_explanations_are_of_families_and_facts_that_there_are() -> None:
    for each in EXPLANATIONS:
        assert each.family in BY_NAME
        check(each.when, each.subject)
    for consequence in CONSEQUENCES:
        assert set(consequence.rules) <= set(RULES)
        assert {id for id in consequence.ids if not id.isdecimal()} <= set(BY_NAME)
        for name in set(consequence.ids) & set(BY_NAME):
            assert not set(BY_NAME[name].rules) & set(consequence.rules), (
                "it is an answer, not a consequence"
            )
    for family in FAMILIES:
        for subject, when, words in family.scope.when:
            check(when, subject)
            assert words.startswith("it checks ")
            assert all(RULES[rule].subject == subject for rule in family.rules), (
                f"{family.name}: the condition is about another subject"
            )


@pytest.mark.parametrize(
    ("family", "ids"),
    {
        "non-transient-ms-image": [
            "UNASSIGNED-BestPractices-vkCreateImage-non-transient-ms-image",
            "BestPractices-vkCreateImage-non-transient-ms-image",
            "BestPractices-Arm-vkCreateImage-non-transient-ms-image",
        ],
        "too-large-sample-count": [
            "UNASSIGNED-BestPractices-vkCreateImage-too-large-sample-count",
            "BestPractices-IMG-vkCreateImage-too-large-sample-count",
        ],
        "resolving-image": [
            "UNASSIGNED-BestPractices-vkCmdResolveImage-resolving-image",
            "BestPractices-Arm-vkCmdResolveImage-resolving-image",
            "BestPractices-vkCmdResolveImage2KHR-resolving-image",
        ],
        "discarded-then-loaded": [
            "UNASSIGNED-BestPractices-vkCmdBeginRenderPass-StoreOpDontCareThenLoadOpLoad",
            "BestPractices-StoreOpDontCareThenLoadOpLoad",
        ],
        "load-from-undefined": [
            "UNASSIGNED-BestPractices-vkCreateRenderPass-attatchment",
            "BestPractices-vkCreateRenderPass-attachment-color-depth",
            "BestPractices-vkCreateRenderPass-attachment-stencil",
            "VUID-VkAttachmentDescription2-pNext-06704",
        ],
        "resolve-formats": [
            "VUID-VkSubpassDescription2-pResolveAttachments-03068",
            "VUID-VkSubpassDescription2-externalFormatResolve-09339",
            "VUID-VkSubpassDescription-pResolveAttachments-00850",
            "VUID-vkCmdResolveImage2-srcImage-01386",
        ],
        "rasterization-samples": [
            "VUID-vkCmdDraw-rasterizationSamples-04740",
            "VUID-vkCmdDrawIndexed-multisampledRenderToSingleSampled-07284",
        ],
    }.items(),
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_an_id_is_of_its_family_in_every_version_of_the_layer(
    family: str, ids: Sequence[str]
) -> None:
    for id in ids:
        assert classify(id) is BY_NAME[family], id


SAID = dict(
    line.split(" ", 1)
    for line in (ROOT / "tests" / "data" / "layer_messages.txt").read_text().splitlines()
)
"""What the layer says: of what version 1.3.239 does not check, the words of 1.4.360."""


@pytest.mark.parametrize("id", SAID)
def test_a_renumbered_vuid_is_known_by_its_structure_and_its_words(id: str) -> None:
    family = classify(id, SAID[id])
    assert isinstance(family, Family)
    assert classify(WITHOUT_NUMBER.sub("-99999", id), SAID[id]) is family
    assert classify(WITHOUT_NUMBER.sub("-99999", id), "It is wrong.") is None
    assert (
        classify(
            re.sub(r"^VUID-\w+", "VUID-VkBufferCreateInfo", WITHOUT_NUMBER.sub("-99999", id)),
            SAID[id],
        )
        is None
    )


@pytest.mark.parametrize(
    "id",
    [
        "UNASSIGNED-BestPractices-vkCreateInstance-specialuse-extension-debugging",
        "UNASSIGNED-BestPractices-vkCreateDevice-physical-device-features-not-retrieved",
        "UNASSIGNED-BestPractices-vkCreateCommandPool-command-buffer-reset",
        "UNASSIGNED-BestPractices-vkAllocateMemory-small-allocation",
        "BestPractices-vkBindImageMemory-small-dedicated-allocation",
        "UNASSIGNED-BestPractices-vkBeginCommandBuffer-one-time-submit",
        "UNASSIGNED-BestPractices-pipeline-stage-flags",
        "BestPractices-NVIDIA-AllocateMemory-SetPriority",
        "UNASSIGNED-BestPractices-Pipeline-SortAndBind",
        "BestPractices-NVIDIA-CreateImage-Depth32Format",
        "UNASSIGNED-BestPractices-vkCreateDevice-deprecated-extension",
    ],
)
def test_what_every_run_says_is_noise_with_a_reason(id: str) -> None:
    found = classify(id)
    assert isinstance(found, Noise)
    assert found.reason


@pytest.mark.parametrize(
    "id",
    [
        "",
        "Loader Message",
        "VUID-",
        "BestPractices-",
        "VUID-vkDestroyDevice-device-00378",
        "SYNC-HAZARD-X",
    ],
)
def test_what_nobody_answers_to_has_no_family(id: str) -> None:
    assert (
        classify(
            id,
            "OBJ ERROR : For VkDevice 0x55b60970d0d0[], VkImage 0x20000000002[] has not been "
            "destroyed.",
        )
        is None
    )


def test_a_sentence_is_what_the_layer_says_without_its_surroundings() -> None:
    text = (
        "Validation Performance Warning: [ UNASSIGNED-BestPractices-vkCreateImage-x ] Object 0: "
        "handle = 0x55b60970d0d0, type = "
        "VK_OBJECT_TYPE_DEVICE; | MessageID = 0x331044c2 | [Arm] [IMG] vkCreateImage(): VkImage "
        "0x2000[color_ms] is\nlarge, "
        "0x55b60970d0d0[] of format 0x00000005 too. The Vulkan spec states: small is good "
        "(https://example.org/#VUID)"
    )
    assert (
        sentence(text)
        == "vkCreateImage(): VkImage 0x2000[color_ms] is large, ... of format 0x00000005 too."
    )
    assert sentence(text.replace("0x2000[", "0x200000002[")).startswith(
        "vkCreateImage(): VkImage `color_ms` is large"
    )
    assert bare("UNASSIGNED-BestPractices-Arm-x") == "x"


FRAME = """
images:
  ms: {{format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT{usage}], memory: [DEVICE_LOCAL]}}
  out: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED], memory: [DEVICE_LOCAL]}}
renderPasses:
  main:
    attachments:
      color: {{image: ms, loadOp: {load}, storeOp: {store}, initialLayout: COLOR_ATTACHMENT_OPTIMAL, finalLayout: COLOR_ATTACHMENT_OPTIMAL}}
      out: {{image: out, loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: SHADER_READ_ONLY_OPTIMAL}}
    subpasses:
      - {{colorAttachments: [color], resolveAttachments: [out]}}
"""
AFTER = """\
  after:
    attachments:
      out: {image: out, loadOp: LOAD, storeOp: STORE, initialLayout: SHADER_READ_ONLY_OPTIMAL, finalLayout: SHADER_READ_ONLY_OPTIMAL}
    subpasses:
      - {colorAttachments: [out]}
"""

NON_TRANSIENT = "UNASSIGNED-BestPractices-vkCreateImage-non-transient-ms-image"
REQUIRES_MEMORY = "UNASSIGNED-BestPractices-vkCreateRenderPass-image-requires-memory"
READBACK = "UNASSIGNED-BestPractices-vkCmdBeginRenderPass-attachment-needs-readback"
EVERYTHING = LayerScope(
    (1, 4, 309), frozenset({"arm", "img", "amd", "nvidia"}), {0: RENDER_PASS, 1: RENDER_PASS}, True
)


def described(
    usage: str = "", load: str = "CLEAR", store: str = "DONT_CARE", more: str = ""
) -> str:
    return FRAME.format(usage=usage, load=load, store=store) + more


@cache
def linted_of(text: str) -> FileResult:
    linted = ENGINE.lint(
        text.encode(), "frame", LintOptions(lambda rule, suggested, vendor: suggested)
    )
    assert not [found for found in linted.findings if found.fatal], linted.findings
    return linted


def rows(
    text: str, *messages: Message, at: LayerScope = EVERYTHING
) -> dict[int, list[AgreementRow]]:
    linted = linted_of(text)
    (judged,) = linted.documents
    frame = Frame(judged.document)
    passes = {number: each.name for number, each in enumerate(frame.passes)}
    found = agreement(frame, passes, linted.findings, messages, at, linted.undecided, judged.device)
    assert list(found) == list(passes)
    return found


def said(id: str, number: int | None = 0, text: str = "It is so.") -> Message:
    return Message(id, text, number)


def only(
    found: Mapping[int, Sequence[AgreementRow]], verdict: str, number: int = 0
) -> list[AgreementRow]:
    return [row for row in found[number] if row.verdict == verdict]


def test_both() -> None:
    found = rows(described(), said(NON_TRANSIENT))
    assert found[0][0] == AgreementRow(
        BOTH,
        NON_TRANSIENT,
        "non-transient-ms-image",
        "multisampled-image-not-transient",
        "It is so.",
    )
    assert "multisampled-image-not-transient" not in [row.rule for row in only(found, OURS)]
    assert not only(found, THEIRS)


def test_a_message_that_two_findings_answer_to_is_told_with_each() -> None:
    text = DEPTH.replace("loadOp: CLEAR, storeOp: DONT_CARE", "loadOp: LOAD, storeOp: DONT_CARE")
    found = rows(text, said(REQUIRES_MEMORY), said(REQUIRES_MEMORY))
    assert [row.rule for row in only(found, BOTH)] == [
        "multisampled-attachment-loaded",
        "multisampled-depth-stored",
    ]


def test_theirs_alone_is_shown() -> None:
    found = rows(
        described(usage=", TRANSIENT_ATTACHMENT"),
        said(NON_TRANSIENT),
        said("VUID-vkDestroyDevice-device-00378"),
    )
    assert only(found, THEIRS) == [
        AgreementRow(THEIRS, NON_TRANSIENT, "non-transient-ms-image", text="It is so."),
        AgreementRow(THEIRS, "VUID-vkDestroyDevice-device-00378", text="It is so."),
    ]


def test_noise() -> None:
    found = rows(described(), said("UNASSIGNED-BestPractices-vkAllocateMemory-small-allocation"))
    (row,) = only(found, NOISE)
    assert (row.family, row.rule) == ("", "")
    assert "confirm allocates" in row.reason


def test_sampled_images_explain_that_they_are_not_transient() -> None:
    sampled = described(usage=", SAMPLED", more="commands:\n  - readImage: {image: ms}\n")
    (row,) = only(rows(sampled, said(NON_TRANSIENT)), EXPLAINED)
    assert row.rule == ""
    assert "is not possible" in row.reason


def test_what_the_description_does_not_say_explains_our_silence() -> None:
    """Without `usage` it is unknown whether the image is transient."""
    text = described().replace("usage: [COLOR_ATTACHMENT], ", "", 1)
    (row,) = only(rows(text, said(NON_TRANSIENT)), EXPLAINED)
    assert row.reason.startswith(
        "multisampled-image-not-transient is undecided: the description does not state "
    )
    assert row.reason.endswith(" images.ms.usage")


def test_a_consequence_names_the_finding_that_it_follows_from() -> None:
    text = described(load="LOAD").replace("COLOR_ATTACHMENT_OPTIMAL, final", "UNDEFINED, final", 1)
    text = text.replace("samples: 4", "samples: 1", 1).replace(", resolveAttachments: [out]", "")
    (row,) = only(rows(text, said(READBACK)), EXPLAINED)
    assert row.reason.startswith("follows from load-from-undefined: ")


def test_a_message_of_one_pass_is_not_answered_by_a_finding_of_another() -> None:
    text = described(more=AFTER)
    (row,) = only(rows(text, said(READBACK, 1)), BOTH, 1)
    assert row.rule == "framebuffer-readback"
    (row,) = only(rows(text, said(READBACK, 0)), THEIRS, 0)
    assert row.family == "attachment-needs-readback"
    # What the pass finds is not lost by that.
    assert "framebuffer-readback" in [
        row.rule for row in only(rows(text, said(READBACK, 0)), OURS, 1)
    ]


def test_a_message_of_no_pass_goes_to_the_pass_that_it_is_about() -> None:
    text = described(more=AFTER)
    found = rows(text, said(READBACK, None))
    assert [row.rule for row in only(found, BOTH, 1)] == ["framebuffer-readback"]
    assert not [row for row in found[0] if row.id]
    found = rows(text, said("VUID-x-y-00000", None))
    assert [row.id for row in only(found, THEIRS, 0)] == ["VUID-x-y-00000"]
    assert not [row for row in found[1] if row.id]


def test_a_message_about_two_passes_may_be_answered_by_the_other() -> None:
    text = described(store="STORE", more=AFTER)
    found = rows(text, said("BestPractices-RenderPass-redundant-store", 1))
    assert [row.rule for row in only(found, BOTH, 1)] == ["multisampled-attachment-stored"]


def test_a_finding_about_what_passes_share_is_answered_once() -> None:
    second = (
        AFTER.replace("image: out", "image: ms")
        .replace("SHADER_READ_ONLY", "COLOR_ATTACHMENT")
        .replace("LOAD,", "DONT_CARE,")
    )
    found = rows(described(more=second), said(NON_TRANSIENT, 0))
    assert [row.rule for row in only(found, BOTH, 0)] == ["multisampled-image-not-transient"]
    assert "multisampled-image-not-transient" not in [row.rule for row in found[1]]


def test_the_same_message_of_two_objects_is_one() -> None:
    twice = [said(NON_TRANSIENT, text=f"image (0x55b60962{n}320) is so") for n in (1, 2)]
    assert len(only(rows(described(), *twice), BOTH)) == 1


def reason(text: str, rule: str, at: LayerScope) -> AgreementRow:
    (row,) = [row for row in only(rows(text, at=at), OURS) if row.rule == rule]
    return row


DEPTH = (
    described()
    .replace(
        "  out: {f",
        "  depth: {format: D32_SFLOAT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT]}\n  out: {f",
    )
    .replace(
        "    subpasses",
        "      depth: {image: depth, loadOp: CLEAR, storeOp: STORE, initialLayout: UNDEFINED}\n    "
        "subpasses",
    )
    .replace("[out]}", "[out], depthStencilAttachment: depth}")
)


@pytest.mark.parametrize(
    ("text", "rule", "changed", "expected"),
    [
        (DEPTH, "multisampled-depth-stored", {"kinds": {0: RENDER_PASS_2},
        "vendors": frozenset({"arm"})},
         "it checks passes of vkCreateRenderPass only; it checks what a later pass clears"),
        (DEPTH, "multisampled-depth-stored", {"kinds": {0: RENDERING}},
         "it checks passes of vkCreateRenderPass only; it checks render passes only"),
        (described(), "multisampled-image-not-transient", {"vendors": frozenset({"amd"}),
        "lazy_memory": False, "device": "llvmpipe"},
         "the checks for Arm and IMG are off; llvmpipe has no lazily allocated memory"),
        ("device: mali-g76\n" + described().replace("samples: 4", "samples: 16"),
        "sample-count-unsupported", {"device": "llvmpipe"},
         "it checks against llvmpipe and what is enabled there, not against the device that the "
         "description is for"),
    ],
    ids=["kind of pass and another matter", "dynamic rendering", "vendors and memory", "another "
        "device"],
)  # fmt: skip
def test_ours_alone_says_why_the_layer_does_not_look(
    text: str, rule: str, changed: Mapping[str, object], expected: str
) -> None:
    row = reason(text, rule, EVERYTHING._replace(**changed))  # type: ignore[arg-type]
    assert row.reason == expected
    assert not row.expected


RENDERED = """
images:
  ms: {format: D24_UNORM_S8_UINT, samples: 4}
  c: {format: R8G8B8A8_UNORM, samples: 4}
  out: {format: D24_UNORM_S8_UINT, samples: 1}
  cout: {format: R8G8B8A8_UNORM, samples: 1}
commands:
  - beginRendering:
      colorAttachments: [{image: c, loadOp: CLEAR, storeOp: STORE, resolveMode: MODE, resolveImage: cout}]
      depthAttachment: {image: ms, loadOp: CLEAR, storeOp: STORE, resolveMode: NONE, resolveImage: out}
  - endRendering
"""


def test_ours_alone_where_the_layer_is_too_old_or_looks_at_colour_alone() -> None:
    rendering = EVERYTHING._replace(kinds={0: RENDERING})
    color = RENDERED.replace("MODE", "NONE", 1)
    found = [
        row
        for row in only(rows(color, at=rendering._replace(version=(1, 3, 239))), OURS)
        if row.rule == "resolve-mode-none"
    ]
    assert {row.reason for row in found} == {"layers have this check since 1.3.278"}
    found = [
        row for row in only(rows(color, at=rendering), OURS) if row.rule == "resolve-mode-none"
    ]
    assert [(row.expected, row.reason) for row in found] == [
        (True, f"{SILENT} (resolve-mode-none)"),
        (False, "it checks color only"),
    ]


def test_ours_alone_without_any_check_of_the_layer() -> None:
    text = described().replace(
        "loadOp: DONT_CARE, storeOp: STORE", "loadOp: CLEAR, storeOp: DONT_CARE"
    )
    row = reason(text, "resolve-target-not-stored", EVERYTHING._replace(kinds={0: RENDERING}))
    assert row.reason == "it checks render passes only"
    row = reason(
        "scene: {color: LDR}\n" + described().replace("samples: 4", "samples: 8"),
        "sample-count-not-portable",
        EVERYTHING,
    )
    assert row.reason == NO_CHECK
    assert not row.expected


def test_ours_alone_where_the_layer_should_have_said_it() -> None:
    row = reason(described(), "multisampled-image-not-transient", EVERYTHING)
    assert row.expected
    assert row.reason == f"{SILENT} (non-transient-ms-image, should-be-transient)"


@cache
def _names() -> tuple[str, ...]:
    return tuple(id for each in (*FAMILIES, *LEFT_OUT) for id in each.ids)


@given(
    st.lists(
        st.builds(
            Message,
            st.sampled_from(
                [of + id for id in _names() for of in ("BestPractices-", "VUID-VkX-y-")]
            )
            | st.text(min_size=1, max_size=30),
            st.text(max_size=40),
            st.sampled_from([None, 0, 1, 7]),
        ),
        max_size=8,
    ),
    st.sampled_from(
        [
            described(more=AFTER),
            described(load="LOAD", store="STORE", more=AFTER),
            described(usage=", SAMPLED", more=AFTER),
        ]
    ),
)
def test_nothing_that_is_said_or_found_is_lost(messages: list[Message], text: str) -> None:
    found = [row for each in rows(text, *messages).values() for row in each]
    assert {row.id for row in found if row.verdict != OURS} == {message.id for message in messages}
    assert {row.rule for row in found if row.rule} == {
        finding.rule for finding in linted_of(text).findings
    }
    for row in found:
        assert bool(row.id) != (row.verdict == OURS)
        assert bool(row.rule) == (row.verdict in (BOTH, OURS))
        assert bool(row.reason) == (row.verdict in (OURS, EXPLAINED, NOISE))


def test_what_the_layer_looks_at_is_read_from_what_the_child_says() -> None:
    device = {
        "properties": {"deviceName": "llvmpipe"},
        "memory": {"memoryTypes": [{"propertyFlags": 15}, {"propertyFlags": 17}]},
    }
    layer = {"name": "VK_LAYER_KHRONOS_validation", "version": "1.3.239", "vendors": ["arm"]}
    assert layer_scope(layer, device, {0: RENDERING}) == LayerScope(
        (1, 3, 239), frozenset({"arm"}), {0: RENDERING}, True, "llvmpipe"
    )
    newer = layer_scope({"version": "1.4.309"}, {}, {}, ["img"])
    assert newer == LayerScope((1, 4, 309), frozenset({"img"}), {}, None, "unnamed device")
    desktop = layer_scope(
        {"version": "1.3.250"}, {"memory": {"memoryTypes": [{"propertyFlags": 15}]}}, {}
    )
    assert (desktop.version, desktop.lazy_memory) == ((1, 3, 250), False)
    assert layer_scope({"version": "?", "vendors": 7}, {"memory": 7}, {}).version is None
    assert layer_scope(None, {}, {}).vendors == frozenset()


def test_the_kind_of_a_pass_is_what_creates_it() -> None:
    assert [pass_kind(1, False), pass_kind(2, False), pass_kind(1, True)] == [
        RENDER_PASS,
        RENDER_PASS_2,
        RENDERING,
    ]


def test_the_page_of_the_agreement_is_fresh() -> None:
    """It has every rule."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, str(ROOT / "docs" / "agreement.py"), "--check"],
        env=environment,
        check=False,
    )
    assert done.returncode == 0, (
        "stale: `PYTHONPATH=. python docs/agreement.py` writes docs/agreement.md anew"
    )


def test_an_error_of_the_layer_agrees_with_no_rule_about_what_is_allowed() -> None:
    """Rules that report errors in some cases alone are named."""
    errors = [family for family in FAMILIES if any(id.isdecimal() for id in family.ids)]
    milder = {rule for family in errors for rule in family.rules if RULES[rule].severity != "error"}
    assert milder == {"depth-averaged"}
    assert BY_NAME["color-resolve-mode"].rules == ("color-resolve-mode-invalid",)
