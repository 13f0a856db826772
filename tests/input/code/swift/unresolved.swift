// A resolve texture beside a store action that does not resolve: the drawable stays empty.
import MetalKit

extension MTLRenderPassDescriptor {
    func configure(color: MTLTexture, resolve: MTLTexture) {
        colorAttachments[0].texture = color
        colorAttachments[0].resolveTexture = resolve
        colorAttachments[0].loadAction = .clear
        colorAttachments[0].storeAction = .store  // expect: MSAA806
    }
}

final class Painter {
    let device: MTLDevice
    lazy var canvas: MTLTexture = {
        let d = MTLTextureDescriptor.texture2DDescriptor(pixelFormat: .bgra8Unorm, width: 512, height: 512, mipmapped: false)
        d.textureType = .type2DMultisample
        d.sampleCount = 2
        d.usage = .renderTarget
        d.storageMode = .private
        return device.makeTexture(descriptor: d)!
    }()

    init(device: MTLDevice) { self.device = device }

    func paint(_ view: MTKView, with buffer: MTLCommandBuffer) {
        autoreleasepool {
            let descriptor = MTLRenderPassDescriptor()
            descriptor.configure(color: canvas, resolve: view.currentDrawable!.texture)
            let encoder = buffer.makeRenderCommandEncoder(descriptor: descriptor)!
            encoder.endEncoding()
            buffer.present(view.currentDrawable!)
        }
    }
}
