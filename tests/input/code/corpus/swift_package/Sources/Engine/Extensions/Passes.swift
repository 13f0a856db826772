import Metal

extension MTLRenderPassDescriptor {
    convenience init(samples: MTLTexture, target: MTLTexture) {
        self.init()
        colorAttachments[0].texture = samples
        colorAttachments[0].resolveTexture = target
        colorAttachments[0].loadAction = .clear
        colorAttachments[0].storeAction = .storeAndMultisampleResolve // expect: MSAA801
    }
}

extension MTLTextureDescriptor {
    static func samples(width: Int, height: Int) -> MTLTextureDescriptor {
        let descriptor = MTLTextureDescriptor.texture2DDescriptor(
            pixelFormat: .bgra8Unorm, width: width, height: height, mipmapped: false)
        descriptor.textureType = .type2DMultisample
        descriptor.sampleCount = Quality.samples
        descriptor.usage = .renderTarget
        descriptor.storageMode = .private
        return descriptor
    }
}
