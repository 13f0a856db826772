// The multisampled texture may be read by shaders, which nothing does, and which keeps it out of tile memory.
import ARKit
import Metal

enum TextureFactory {
    static let sampleCount = 4

    static func multisampled(on device: MTLDevice, width: Int, height: Int) throws -> MTLTexture {
        let d = MTLTextureDescriptor()
        d.pixelFormat = .rgba8Unorm
        d.width = width; d.height = height
        d.textureType = .type2DMultisample
        d.sampleCount = sampleCount
        d.usage = [.renderTarget, .shaderRead]  // expect: MSAA805
        d.storageMode = .private
        guard let texture = device.makeTexture(descriptor: d) else {
            throw NSError(domain: "textures", code: 1)
        }
        return texture
    }
}

final class OverlayRenderer {
    private let device: MTLDevice
    private let overlay: MTLTexture
    private let queue: MTLCommandQueue

    init(device: MTLDevice, queue: MTLCommandQueue) throws {
        self.device = device
        self.queue = queue
        overlay = try TextureFactory.multisampled(on: device, width: 1024, height: 768)
    }

    func draw(into drawable: CAMetalDrawable) {
        let target = MTLRenderPassDescriptor()
        target.colorAttachments[0].texture = overlay
        target.colorAttachments[0].resolveTexture = drawable.texture
        target.colorAttachments[0].loadAction = .clear
        target.colorAttachments[0].storeAction = .multisampleResolve
        guard let commands = queue.makeCommandBuffer() else { return }
        commands.makeRenderCommandEncoder(descriptor: target)?.endEncoding()
        commands.present(drawable)
        commands.commit()
    }
}
