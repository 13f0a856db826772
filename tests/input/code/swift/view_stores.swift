// What MTKView makes is changed: samples and depth are stored though nothing reads them.
import MetalKit

class GameView: MTKView {
    var pipelineState: MTLRenderPipelineState?
    private lazy var queue = device!.makeCommandQueue()!

    required init(coder: NSCoder) {
        super.init(coder: coder)
        self.sampleCount = 4
        colorPixelFormat = .bgra8Unorm
        depthStencilPixelFormat = .depth32Float_stencil8
        let descriptor = MTLRenderPipelineDescriptor()
        descriptor.rasterSampleCount = sampleCount
        descriptor.colorAttachments[0].pixelFormat = colorPixelFormat
        descriptor.depthAttachmentPixelFormat = depthStencilPixelFormat
        descriptor.stencilAttachmentPixelFormat = depthStencilPixelFormat
        pipelineState = try? device?.makeRenderPipelineState(descriptor: descriptor)
    }

    override func draw(_ rect: CGRect) {
        guard let pass = currentRenderPassDescriptor, let drawable = currentDrawable, let pipelineState else { return }
        pass.colorAttachments[0].storeAction = .storeAndMultisampleResolve  // expect: MSAA801
        pass.depthAttachment.storeAction = .store  // expect: MSAA802
        let buffer = queue.makeCommandBuffer()!
        let encoder = buffer.makeRenderCommandEncoder(descriptor: pass)!
        encoder.setRenderPipelineState(pipelineState)
        encoder.endEncoding()
        buffer.present(drawable)
        buffer.commit()
    }
}
