// Targets that live in tile memory alone, made by one function for colour and depth: nothing to report.
import Metal
import QuartzCore
import UIKit

struct Targets {
    let color: MTLTexture
    let depth: MTLTexture
}

final class LayerRenderer {
    static let sampleCount = 4
    let device: MTLDevice
    let queue: MTLCommandQueue
    let layer: CAMetalLayer
    private var targets: Targets?

    init(layer: CAMetalLayer, device: MTLDevice) {
        self.layer = layer
        self.device = device
        self.queue = device.makeCommandQueue()!
        layer.pixelFormat = .bgra8Unorm
    }

    private func makeTarget(_ format: MTLPixelFormat, size: CGSize) -> MTLTexture {
        let descriptor = MTLTextureDescriptor()
        descriptor.textureType = .type2DMultisample
        descriptor.pixelFormat = format
        descriptor.width = Int(size.width)
        descriptor.height = Int(size.height)
        descriptor.sampleCount = Self.sampleCount
        descriptor.usage = .renderTarget
        descriptor.storageMode = .memoryless
        return device.makeTexture(descriptor: descriptor)!
    }

    func resize(to size: CGSize) {
        layer.drawableSize = size
        let color = makeTarget(.bgra8Unorm, size: size)
        let depth = makeTarget(.depth32Float, size: size)
        targets = Targets(color: color, depth: depth)
    }

    func render() {
        guard let targets, let drawable = layer.nextDrawable(), let commandBuffer = queue.makeCommandBuffer() else { return }
        let pass = MTLRenderPassDescriptor()
        pass.colorAttachments[0].texture = targets.color
        pass.colorAttachments[0].resolveTexture = drawable.texture
        pass.colorAttachments[0].loadAction = .clear
        pass.colorAttachments[0].storeAction = .multisampleResolve
        pass.depthAttachment.texture = targets.depth
        pass.depthAttachment.loadAction = .clear
        pass.depthAttachment.storeAction = .dontCare
        let encoder = commandBuffer.makeRenderCommandEncoder(descriptor: pass)!
        encoder.endEncoding()
        commandBuffer.present(drawable)
        commandBuffer.commit()
    }
}
