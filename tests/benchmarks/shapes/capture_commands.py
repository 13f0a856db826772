"""Programs for `captures`: sets and passes that read them, secondary command buffers, and command
buffers submitted again and again.
"""

from __future__ import annotations

from tests.input.captures.program import COLOR, SAMPLED, Program, attachment


class Target:
    """What a pass needs: an image, its view, a render pass and a framebuffer."""

    def __init__(self, program: Program) -> None:
        self.image = program.image()
        self.view = program.view(self.image)
        self.render_pass = program.render_pass([attachment()])
        self.framebuffer = program.framebuffer(self.render_pass, [self.view])


def pass_of(program: Program, target: Target, buffer: int, draws: int = 1) -> None:
    program.begin(buffer, target.render_pass, target.framebuffer)
    for _ in range(draws):
        program.draw(buffer)
    program.end(buffer)


def frame(program: Program, *buffers: int) -> None:
    program.submit(*buffers)
    program.present()


def passes_of_sets(program: Program, count: int) -> None:
    """As many passes as a set has images: each reads all."""
    target = Target(program)
    bound = program.descriptor_set()
    for binding in range(count):
        program.write(bound, program.view(program.image(samples=1, usage=COLOR | SAMPLED)), binding)
    buffer = program.buffer()
    program.bind(buffer, bound)
    for _ in range(count):
        pass_of(program, target, buffer)
    program.submit(buffer)


def passes_of_unknown_sets(program: Program, count: int) -> None:
    """Passes that read a set whose contents the capture omits, so that they may read any image."""
    target = Target(program)
    bound = program.descriptor_set()
    for _ in range(count):
        program.image(samples=1, usage=COLOR | SAMPLED)
    program.call("vkUpdateDescriptorSetWithTemplate", device=2, descriptorSet=bound)
    buffer = program.buffer()
    program.bind(buffer, bound)
    for _ in range(count):
        pass_of(program, target, buffer)
    program.submit(buffer)


def layouts_of_pipelines(program: Program, count: int) -> None:
    """Pipelines with one layout of many bindings, each drawn with a set that a template of as many
    entries writes.
    """
    target = Target(program)
    kind = "VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE"
    size = min(count, 4000)
    bindings = [
        {"binding": each, "descriptorType": kind, "descriptorCount": 1, "stageFlags": 16}
        for each in range(size)
    ]
    program.call(
        "vkCreateDescriptorSetLayout", device=2, pCreateInfo={"pBindings": bindings}, pSetLayout=70
    )
    program.call(
        "vkCreatePipelineLayout",
        device=2,
        pCreateInfo={"pSetLayouts": [70] * 8},
        pPipelineLayout=71,
    )
    entries = [
        {"dstBinding": each, "descriptorType": kind, "descriptorCount": 1} for each in range(size)
    ]
    info = {"pDescriptorUpdateEntries": entries, "pipelineBindPoint": 0}
    program.call(
        "vkCreateDescriptorUpdateTemplate", device=2, pCreateInfo=info, pDescriptorUpdateTemplate=72
    )
    bound = program.descriptor_set()
    buffer = program.buffer()
    for number in range(count):
        image = program.image(samples=1, usage=COLOR | SAMPLED)
        change = {
            "image": image,
            "oldLayout": "VK_IMAGE_LAYOUT_UNDEFINED",
            "newLayout": "VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL",
        }
        program.call("vkCmdPipelineBarrier", commandBuffer=buffer, pImageMemoryBarriers=[change])
        pipeline = program.pipeline(target.render_pass)
        program.calls[-1][1]["pCreateInfos"][0]["layout"] = 71
        program.begin(buffer, target.render_pass, target.framebuffer)
        if number % 2:
            program.call(
                "vkUpdateDescriptorSetWithTemplate",
                device=2,
                descriptorSet=bound,
                descriptorUpdateTemplate=72,
                pData={},
            )
            program.bind(buffer, bound)
        else:
            pushed = {"descriptorUpdateTemplate": 72, "layout": 71, "set": 0, "pData": {}}
            program.call("vkCmdPushDescriptorSetWithTemplate", commandBuffer=buffer, **pushed)
        program.draw(buffer, pipeline)
        program.end(buffer)
    program.submit(buffer)


def dispatches_of_sets(program: Program, count: int) -> None:
    target = Target(program)
    bound = program.descriptor_set()
    for binding in range(count):
        program.write(bound, program.view(program.image(samples=1, usage=COLOR | SAMPLED)), binding)
    buffer = program.buffer()
    program.call(
        "vkCmdBindDescriptorSets",
        commandBuffer=buffer,
        pipelineBindPoint="COMPUTE",
        firstSet=0,
        pDescriptorSets=[bound],
    )
    for _ in range(count):
        program.call(
            "vkCmdDispatch", commandBuffer=buffer, groupCountX=1, groupCountY=1, groupCountZ=1
        )
    pass_of(program, target, buffer)
    program.submit(buffer)


def set_copies(program: Program, count: int) -> None:
    """A set of many images, copied to as many sets."""
    source = program.descriptor_set()
    for binding in range(count):
        program.write(
            source, program.view(program.image(samples=1, usage=COLOR | SAMPLED)), binding
        )
    for _ in range(count):
        copied = program.descriptor_set()
        program.call(
            "vkUpdateDescriptorSets",
            device=2,
            pDescriptorCopies=[{"srcSet": source, "dstSet": copied, "descriptorCount": 1}],
        )


def pushed_sets(program: Program, count: int) -> None:
    """Pushes into one set, a binding at a time, each before a pass."""
    target = Target(program)
    buffer = program.buffer()
    for binding in range(count):
        view = program.view(program.image(samples=1, usage=COLOR | SAMPLED))
        write = {
            "dstBinding": binding,
            "descriptorType": "VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE",
            "pImageInfo": [{"imageView": view}],
        }
        program.call("vkCmdPushDescriptorSetKHR", commandBuffer=buffer,
        pipelineBindPoint="VK_PIPELINE_BIND_POINT_GRAPHICS", set=0,
                     pDescriptorWrites=[write])  # fmt: skip
        pass_of(program, target, buffer)
    program.submit(buffer)


def many_sets(program: Program, count: int) -> None:
    """Sets bound at rising slots, and a draw after each."""
    target = Target(program)
    buffer = program.buffer()
    view = program.view(program.image(samples=1, usage=COLOR | SAMPLED))
    program.begin(buffer, target.render_pass, target.framebuffer)
    for slot in range(count):
        bound = program.descriptor_set()
        program.write(bound, view)
        program.call("vkCmdBindDescriptorSets", commandBuffer=buffer,
        pipelineBindPoint="VK_PIPELINE_BIND_POINT_GRAPHICS", firstSet=slot,
                     pDescriptorSets=[bound])  # fmt: skip
        program.draw(buffer)
    program.end(buffer)
    program.submit(buffer)


def nested(program: Program, depth: int) -> None:
    """Each secondary command buffer executes the one before it twice."""
    target = Target(program)
    below = program.buffer(secondary=True)
    program.draw(below, program.pipeline())
    pass_of(program, target, below)
    for _ in range(depth):
        above = program.buffer(secondary=True)
        program.call("vkCmdExecuteCommands", commandBuffer=above, pCommandBuffers=[below, below])
        below = above
    buffer = program.buffer()
    program.call("vkCmdExecuteCommands", commandBuffer=buffer, pCommandBuffers=[below])
    program.submit(buffer)


def nested_once(program: Program, depth: int) -> None:
    """Each secondary command buffer executes the one before it, after a pass."""
    target = Target(program)
    below = program.buffer(secondary=True)
    for _ in range(depth):
        above = program.buffer(secondary=True)
        pass_of(program, target, above)
        program.call("vkCmdExecuteCommands", commandBuffer=above, pCommandBuffers=[below])
        below = above
    program.submit(below)


def executions(program: Program, count: int) -> None:
    """As many executions as a secondary command buffer has passes."""
    target = Target(program)
    secondary = program.buffer(secondary=True)
    for _ in range(count):
        pass_of(program, target, secondary)
    buffer = program.buffer()
    for _ in range(count):
        program.call("vkCmdExecuteCommands", commandBuffer=buffer, pCommandBuffers=[secondary])
    program.submit(buffer)


def submissions(program: Program, count: int) -> None:
    """A command buffer with many passes, submitted as often, within a frame that presents end."""
    program.swap()
    target = Target(program)
    buffer = program.buffer()
    for _ in range(count):
        pass_of(program, target, buffer)
    for _ in range(count):
        program.call(
            "vkQueueSubmit",
            queue=5,
            submitCount=1,
            pSubmits=[{"pCommandBuffers": [buffer]}],
            fence=0,
        )
    program.present()


def submissions_as_frames(program: Program, count: int) -> None:
    """The same without presents: each is a frame."""
    target = Target(program)
    buffer = program.buffer()
    for _ in range(count):
        pass_of(program, target, buffer)
    for _ in range(count):
        program.call(
            "vkQueueSubmit",
            queue=5,
            submitCount=1,
            pSubmits=[{"pCommandBuffers": [buffer]}],
            fence=0,
        )


def one_pass_submissions(program: Program, count: int) -> None:
    program.swap()
    target = Target(program)
    buffer = program.buffer()
    pass_of(program, target, buffer)
    program.call("vkEndCommandBuffer", commandBuffer=buffer)
    for _ in range(count):
        program.call(
            "vkQueueSubmit",
            queue=5,
            submitCount=1,
            pSubmits=[{"pCommandBuffers": [buffer]}],
            fence=0,
        )
    program.present()
