// Samples that a shader of its own resolves, for tone mapping: stored with reason, though a tile function could resolve them on the tile.
import Metal
import QuartzCore

final class HDRRenderer {
    private let device: MTLDevice
    private let queue: MTLCommandQueue
    private let layer: CAMetalLayer
    private let resolvePipeline: MTLRenderPipelineState
    private var hdrColor: MTLTexture!
    private var hdrDepth: MTLTexture!

    init(device: MTLDevice, layer: CAMetalLayer, library: MTLLibrary) throws {
        self.device = device
        self.queue = device.makeCommandQueue()!
        self.layer = layer
        let descriptor = MTLRenderPipelineDescriptor()
        descriptor.vertexFunction = library.makeFunction(name: "fullscreen")
        descriptor.fragmentFunction = library.makeFunction(name: "toneMapAndResolve")
        descriptor.colorAttachments[0].pixelFormat = .bgra8Unorm
        resolvePipeline = try device.makeRenderPipelineState(descriptor: descriptor)
        layer.pixelFormat = .bgra8Unorm
    }

    private func texture(_ pixelFormat: MTLPixelFormat, usage: MTLTextureUsage, mode: MTLStorageMode, width: Int, height: Int) -> MTLTexture? {
        let d = MTLTextureDescriptor()
        (d.width, d.height) = (width, height)
        d.pixelFormat = pixelFormat
        d.textureType = .type2DMultisample
        d.sampleCount = 4
        d.usage = usage
        d.storageMode = mode
        return device.makeTexture(descriptor: d)
    }

    func resize(width: Int, height: Int) {
        hdrColor = texture(.rgba16Float, usage: [.renderTarget, .shaderRead], mode: .private, width: width, height: height)
        hdrDepth = texture(.depth32Float, usage: .renderTarget, mode: .memoryless, width: width, height: height)
    }

    func render(scene: (MTLRenderCommandEncoder) -> Void) {
        guard let drawable = layer.nextDrawable(), let buffer = queue.makeCommandBuffer() else { return }
        let main = MTLRenderPassDescriptor()
        main.colorAttachments[0].texture = hdrColor
        main.colorAttachments[0].loadAction = .clear
        main.colorAttachments[0].storeAction = .store  // expect: MSAA409
        main.depthAttachment.texture = hdrDepth
        main.depthAttachment.clearDepth = 0
        let encoder = buffer.makeRenderCommandEncoder(descriptor: main)!
        scene(encoder)
        encoder.endEncoding()

        let last = MTLRenderPassDescriptor()
        last.colorAttachments[0].texture = drawable.texture
        last.colorAttachments[0].loadAction = .dontCare
        last.colorAttachments[0].storeAction = .store
        let resolve = buffer.makeRenderCommandEncoder(descriptor: last)!
        resolve.setRenderPipelineState(resolvePipeline)
        resolve.setFragmentTexture(hdrColor, index: 0)
        resolve.drawPrimitives(type: .triangle, vertexStart: 0, vertexCount: 3)
        resolve.endEncoding()
        buffer.present(drawable)
        buffer.commit()
    }
}
