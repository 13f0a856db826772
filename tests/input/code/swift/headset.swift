// A headset's drawable brings its textures with it; multisampled targets in tile memory are made when first asked for. Nothing to report.
import CompositorServices
import Metal

actor HeadsetRenderer {
    let layerRenderer: LayerRenderer
    let device: MTLDevice
    let rasterSampleCount: Int
    var memorylessTargets: [(color: MTLTexture, depth: MTLTexture)?] = Array(repeating: nil, count: 3)
    var index = 0

    init(_ layerRenderer: LayerRenderer) {
        self.layerRenderer = layerRenderer
        device = layerRenderer.device
        rasterSampleCount = device.supports32BitMSAA && device.supportsTextureSampleCount(4) ? 4 : 1
    }

    private func targets(for drawable: LayerRenderer.Drawable) -> (color: MTLTexture, depth: MTLTexture) {
        func make(_ like: MTLTexture) -> MTLTexture {
            let descriptor = MTLTextureDescriptor()
            descriptor.textureType = .type2DMultisampleArray
            descriptor.pixelFormat = like.pixelFormat
            descriptor.width = like.width
            descriptor.height = like.height
            descriptor.arrayLength = like.arrayLength
            descriptor.sampleCount = rasterSampleCount
            descriptor.storageMode = .memoryless
            descriptor.usage = .renderTarget
            return device.makeTexture(descriptor: descriptor)!
        }
        let made = (color: make(drawable.colorTextures[0]), depth: make(drawable.depthTextures[0]))
        memorylessTargets[index] = made
        return made
    }

    func renderFrame(drawable: LayerRenderer.Drawable, commandBuffer: MTLCommandBuffer) {
        let descriptor = MTLRenderPassDescriptor()
        if rasterSampleCount > 1 {
            let renderTargets = targets(for: drawable)
            descriptor.colorAttachments[0].resolveTexture = drawable.colorTextures[0]
            descriptor.colorAttachments[0].texture = renderTargets.color
            descriptor.depthAttachment.resolveTexture = drawable.depthTextures[0]
            descriptor.depthAttachment.texture = renderTargets.depth
            descriptor.colorAttachments[0].storeAction = .multisampleResolve
            descriptor.depthAttachment.storeAction = .multisampleResolve
        } else {
            descriptor.colorAttachments[0].texture = drawable.colorTextures[0]
            descriptor.depthAttachment.texture = drawable.depthTextures[0]
            descriptor.colorAttachments[0].storeAction = .store
            descriptor.depthAttachment.storeAction = .store
        }
        descriptor.colorAttachments[0].loadAction = .clear
        descriptor.depthAttachment.loadAction = .clear
        descriptor.depthAttachment.clearDepth = 0.0
        guard let encoder = commandBuffer.makeRenderCommandEncoder(descriptor: descriptor) else { return }
        encoder.endEncoding()
    }
}
