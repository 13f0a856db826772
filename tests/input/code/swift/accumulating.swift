// A canvas that keeps what was painted: samples are stored because the next frame loads them. Nothing to report.
import MetalKit

final class Painting: NSObject, MTKViewDelegate {
    private let queue: MTLCommandQueue
    private var canvas: MTLTexture?
    private var isFresh = true

    init(queue: MTLCommandQueue) {
        self.queue = queue
    }

    func mtkView(_ view: MTKView, drawableSizeWillChange size: CGSize) {
        let d = MTLTextureDescriptor.texture2DDescriptor(
            pixelFormat: view.colorPixelFormat, width: Int(size.width), height: Int(size.height), mipmapped: false)
        d.textureType = .type2DMultisample
        d.sampleCount = 4
        d.usage = [.renderTarget]
        d.storageMode = .private
        canvas = view.device?.makeTexture(descriptor: d)
        isFresh = true
    }

    func draw(in view: MTKView) {
        guard let drawable = view.currentDrawable, let buffer = queue.makeCommandBuffer() else { return }
        let pass = MTLRenderPassDescriptor()
        pass.colorAttachments[0].texture = canvas
        pass.colorAttachments[0].resolveTexture = drawable.texture
        pass.colorAttachments[0].loadAction = isFresh ? .clear : .load
        pass.colorAttachments[0].storeAction = .storeAndMultisampleResolve
        isFresh = false
        buffer.makeRenderCommandEncoder(descriptor: pass)?.endEncoding()
        buffer.present(drawable)
        buffer.commit()
    }
}
