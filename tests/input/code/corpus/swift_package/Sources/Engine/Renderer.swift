import Metal
import QuartzCore

final class Renderer {
    private let device: MTLDevice
    private let queue: MTLCommandQueue
    private var samples: MTLTexture?

    init(device: MTLDevice, queue: MTLCommandQueue) {
        self.device = device
        self.queue = queue
    }

    func resize(width: Int, height: Int) {
        samples = device.makeTexture(descriptor: .samples(width: width, height: height))
    }

    func draw(drawable: CAMetalDrawable) {
        guard let samples = samples, let commands = queue.makeCommandBuffer() else { return }
        let pass = MTLRenderPassDescriptor(samples: samples, target: drawable.texture)
        commands.makeRenderCommandEncoder(descriptor: pass)?.endEncoding()
        commands.present(drawable)
        commands.commit()
    }
}
