// Opaque and transparent things in two passes by one helper, with the samples and the depth handed over through memory.
import Metal

final class Phases {
    private var color: MTLTexture!
    private var depth: MTLTexture!

    func resize(_ device: MTLDevice, width: Int, height: Int) {
        let d = MTLTextureDescriptor()
        d.textureType = .type2DMultisample
        d.sampleCount = 4
        d.width = width
        d.height = height
        d.usage = .renderTarget
        d.pixelFormat = .bgra8Unorm
        color = device.makeTexture(descriptor: d)
        d.pixelFormat = .depth32Float
        depth = device.makeTexture(descriptor: d)
    }

    func draw(_ buffer: MTLCommandBuffer, target: MTLTexture) {
        let opaque = MTLRenderPassDescriptor()
        opaque.colorAttachments[0].texture = color
        opaque.colorAttachments[0].loadAction = .clear
        opaque.colorAttachments[0].storeAction = .store
        opaque.depthAttachment.texture = depth
        opaque.depthAttachment.loadAction = .clear
        opaque.depthAttachment.storeAction = .store
        encode(buffer, opaque)

        let transparent = MTLRenderPassDescriptor()
        transparent.colorAttachments[0].texture = color
        transparent.colorAttachments[0].loadAction = .load  // expect: MSAA808
        transparent.colorAttachments[0].resolveTexture = target
        transparent.colorAttachments[0].storeAction = .multisampleResolve
        transparent.depthAttachment.texture = depth
        transparent.depthAttachment.loadAction = .load  // expect: MSAA808
        transparent.depthAttachment.storeAction = .dontCare
        encode(buffer, transparent)
    }

    private func encode(_ buffer: MTLCommandBuffer, _ descriptor: MTLRenderPassDescriptor) {
        let encoder = buffer.makeRenderCommandEncoder(descriptor: descriptor)!
        encoder.endEncoding()
    }
}
