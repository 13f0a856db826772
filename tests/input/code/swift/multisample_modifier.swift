// A modifier that swaps the target of any pass for a multisampled one: textures are cached, made on demand, and checked against the device.
// The samples are resolved and dropped, so that there is nothing to report.
import Metal

enum ModifierError: Error {
    case noTarget
    case unsupported(Int)
    case noTexture
}

final class MultisampleModifier {
    let sampleCount: Int
    private var colorSamples: MTLTexture?
    private var depthSamples: MTLTexture?

    init(sampleCount: Int = 4) {
        self.sampleCount = sampleCount
    }

    func apply(to descriptor: MTLRenderPassDescriptor, device: MTLDevice) throws -> MTLRenderPassDescriptor {
        guard let target = descriptor.colorAttachments[0].texture else { throw ModifierError.noTarget }
        let copy = descriptor.copy() as! MTLRenderPassDescriptor
        copy.colorAttachments[0].texture = try colorTexture(matching: target, device: device)
        copy.colorAttachments[0].resolveTexture = target
        copy.colorAttachments[0].storeAction = .multisampleResolve
        if let depth = descriptor.depthAttachment?.texture {
            copy.depthAttachment.texture = try depthTexture(matching: depth, device: device)
            copy.depthAttachment.storeAction = .dontCare
        }
        return copy
    }

    private func colorTexture(matching target: MTLTexture, device: MTLDevice) throws -> MTLTexture {
        if let existing = colorSamples, existing.width == target.width, existing.height == target.height { return existing }
        let texture = try makeSamples(matching: target, device: device)
        colorSamples = texture
        return texture
    }

    private func depthTexture(matching target: MTLTexture, device: MTLDevice) throws -> MTLTexture {
        if let existing = depthSamples, existing.width == target.width, existing.height == target.height { return existing }
        let texture = try makeSamples(matching: target, device: device)
        depthSamples = texture
        return texture
    }

    private func makeSamples(matching target: MTLTexture, device: MTLDevice) throws -> MTLTexture {
        guard device.supportsTextureSampleCount(sampleCount) else { throw ModifierError.unsupported(sampleCount) }
        let descriptor = MTLTextureDescriptor.texture2DDescriptor(
            pixelFormat: target.pixelFormat, width: target.width, height: target.height, mipmapped: false)
        descriptor.textureType = .type2DMultisample
        descriptor.sampleCount = sampleCount
        descriptor.usage = [.renderTarget]
        descriptor.storageMode = .private
        guard let texture = device.makeTexture(descriptor: descriptor) else { throw ModifierError.noTexture }
        return texture
    }
}
