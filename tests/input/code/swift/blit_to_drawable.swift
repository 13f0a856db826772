// The resolved picture is copied into the drawable in place of being resolved there; samples are loaded in the second pass.
import Metal
import QuartzCore

private func descriptor(_ w: Int, _ h: Int, format: MTLPixelFormat, samples: Int = 1) -> MTLTextureDescriptor {
    let d = MTLTextureDescriptor.texture2DDescriptor(pixelFormat: format, width: w, height: h, mipmapped: false)
    d.usage = .renderTarget
    d.storageMode = .private
    guard samples > 1 else { return d }
    d.textureType = .type2DMultisample
    d.sampleCount = samples  // expect: MSAA101
    return d
}

final class TwoPasses {
    let gpu: MTLDevice, queue: MTLCommandQueue
    let scene: MTLTexture
    let resolved: MTLTexture

    init?(gpu: MTLDevice) {
        guard gpu.supportsTextureSampleCount(8), let queue = gpu.makeCommandQueue(),
              let scene = gpu.makeTexture(descriptor: descriptor(1280, 720, format: .bgra8Unorm, samples: 8)),
              let resolved = gpu.makeTexture(descriptor: descriptor(1280, 720, format: .bgra8Unorm)) else { return nil }
        self.gpu = gpu
        self.queue = queue
        self.scene = scene
        self.resolved = resolved
    }

    func frame(_ drawable: CAMetalDrawable) {
        let buffer = queue.makeCommandBuffer()!
        let first = MTLRenderPassDescriptor()
        first.colorAttachments[0].texture = scene
        first.colorAttachments[0].loadAction = .clear
        first.colorAttachments[0].storeAction = .store
        buffer.makeRenderCommandEncoder(descriptor: first)!.endEncoding()

        let second = first.copy() as! MTLRenderPassDescriptor
        second.colorAttachments[0].loadAction = .load  // expect: MSAA808
        second.colorAttachments[0].resolveTexture = resolved  // expect: MSAA813
        second.colorAttachments[0].storeAction = .multisampleResolve
        buffer.makeRenderCommandEncoder(descriptor: second)!.endEncoding()

        let blit = buffer.makeBlitCommandEncoder()!
        blit.copy(from: resolved, to: drawable.texture)
        blit.endEncoding()
        buffer.present(drawable)
        buffer.commit()
    }
}
