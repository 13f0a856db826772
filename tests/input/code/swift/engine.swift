// Descriptors that other files fill in, attachments in a loop, actions from tables: what cannot be known. Nothing to report.
import Metal

public struct AttachmentSettings {
    public var load: MTLLoadAction
    public var store: MTLStoreAction
}

public final class RenderGraphPass {
    public let descriptor = MTLRenderPassDescriptor()
    public var settings: [AttachmentSettings]
    let samples: Int
    private let pool: TexturePool

    public init(settings: [AttachmentSettings], samples: Int, pool: TexturePool) {
        self.settings = settings
        self.samples = samples
        self.pool = pool
        for (index, each) in settings.enumerated() {
            descriptor.colorAttachments[index].loadAction = each.load
            descriptor.colorAttachments[index].storeAction = each.store
        }
        descriptor.depthAttachment.storeAction = samples > 1 ? .dontCare : .store
    }

    func attach(_ textures: [MTLTexture], depth: MTLTexture?) {
        for (index, texture) in textures.enumerated() {
            descriptor.colorAttachments[index].texture = texture
        }
        descriptor.depthAttachment.texture = depth
    }

    func makeTarget(format: MTLPixelFormat, usage: MTLTextureUsage, transient: Bool) -> MTLTexture? {
        let d = MTLTextureDescriptor.texture2DDescriptor(pixelFormat: format, width: 8, height: 8, mipmapped: false)
        pool.configure(d, samples: samples)
        d.usage = usage
        d.storageMode = transient ? .memoryless : .private
        return pool.device.makeTexture(descriptor: d)
    }

    func pipeline(_ base: MTLRenderPipelineDescriptor) throws -> MTLRenderPipelineState {
        let d = base.copy() as! MTLRenderPipelineDescriptor
        d.rasterSampleCount = samples
        return try pool.device.makeRenderPipelineState(descriptor: d)
    }
}
