// Memoryless textures that are loaded or stored, and a resolve that has nowhere to go.
import Metal

extension MTLTextureDescriptor {
    static func target(_ format: MTLPixelFormat, width: Int, height: Int) -> MTLTextureDescriptor {
        let descriptor: MTLTextureDescriptor = .init()
        descriptor.pixelFormat = format
        descriptor.width = width
        descriptor.height = height
        descriptor.textureType = .type2DMultisample
        descriptor.sampleCount = Settings.samples
        descriptor.usage = .renderTarget
        descriptor.storageMode = .memoryless
        return descriptor
    }
}

enum Settings {
    static let samples = 4
}

final class Sketch {
    let device: MTLDevice
    private lazy var ink = device.makeTexture(descriptor: .target(.rgba8Unorm, width: 800, height: 600))!
    private lazy var depth: MTLTexture = {
        let texture = device.makeTexture(descriptor: .target(.depth32Float, width: 800, height: 600))!
        texture.label = "depth"
        return texture
    }()

    init(device: MTLDevice) {
        self.device = device
    }

    private func colour(_ texture: MTLTexture, store: MTLStoreAction) -> MTLRenderPassColorAttachmentDescriptor {
        let attachment = MTLRenderPassColorAttachmentDescriptor()
        attachment.texture = texture
        attachment.loadAction = .load  // expect: MSAA804
        attachment.storeAction = store  // expect: MSAA807
        return attachment
    }

    func strokes(into buffer: MTLCommandBuffer) {
        let pass = MTLRenderPassDescriptor()
        pass.colorAttachments[0] = colour(ink, store: .multisampleResolve)
        pass.depthAttachment = .init()
        pass.depthAttachment.texture = depth
        pass.depthAttachment.loadAction = .clear
        pass.depthAttachment.storeAction = .store  // expect: MSAA804
        buffer.makeRenderCommandEncoder(descriptor: pass)?.endEncoding()
    }
}
