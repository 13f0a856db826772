// Colour is stored and resolved though nobody reads its samples, depth is stored for nobody, neither is memoryless.
import Metal
import QuartzCore
import UIKit

class SceneRenderer {
    let device: MTLDevice
    let commandQueue: MTLCommandQueue
    var msaaColor: MTLTexture!
    var msaaDepth: MTLTexture!

    init(device: MTLDevice, size: CGSize) {
        self.device = device
        self.commandQueue = device.makeCommandQueue()!
        let descriptor = MTLTextureDescriptor.texture2DDescriptor(
            pixelFormat: .bgra8Unorm,
            width: Int(size.width),
            height: Int(size.height),
            mipmapped: false
        )
        descriptor.textureType = .type2DMultisample
        descriptor.sampleCount = 4
        descriptor.usage = [.renderTarget]
        descriptor.storageMode = .private  // expect: MSAA803
        msaaColor = device.makeTexture(descriptor: descriptor)
        descriptor.pixelFormat = .depth32Float
        msaaDepth = device.makeTexture(descriptor: descriptor)
    }

    func draw(to layer: CAMetalLayer) {
        guard let drawable = layer.nextDrawable() else { return }
        let renderPass = MTLRenderPassDescriptor()
        if let color = renderPass.colorAttachments[0] {
            color.texture = msaaColor
            color.resolveTexture = drawable.texture
            color.loadAction = .clear
            color.storeAction = .storeAndMultisampleResolve  // expect: MSAA801
            color.clearColor = MTLClearColor(red: 0, green: 0, blue: 0, alpha: 1)
        }
        if let depth = renderPass.depthAttachment {
            depth.texture = msaaDepth
            depth.loadAction = .clear
            depth.storeAction = .store  // expect: MSAA802
            depth.clearDepth = 1.0
        }
        let commandBuffer = commandQueue.makeCommandBuffer()!
        let encoder = commandBuffer.makeRenderCommandEncoder(descriptor: renderPass)!
        encoder.drawPrimitives(type: .triangle, vertexStart: 0, vertexCount: 3)
        encoder.endEncoding()
        commandBuffer.present(drawable)
        commandBuffer.commit()
    }
}
