// The pipeline draws one sample per pixel into a pass of four.
import MetalKit

class MismatchRenderer: NSObject {
    var pipeline: MTLRenderPipelineState!
    var queue: MTLCommandQueue!
    var device: MTLDevice!

    func setup(_ mtkView: MTKView) {
        mtkView.sampleCount = 4
        mtkView.colorPixelFormat = .bgra8Unorm
        let pipelineDescriptor = MTLRenderPipelineDescriptor()
        pipelineDescriptor.rasterSampleCount = 1  // expect: MSAA810
        pipelineDescriptor.colorAttachments[0].pixelFormat = .bgra8Unorm
        pipelineDescriptor.colorAttachments[0].isBlendingEnabled = true
        pipelineDescriptor.isAlphaToCoverageEnabled = false
        pipeline = try! device.makeRenderPipelineState(descriptor: pipelineDescriptor)
    }

    func render(in mtkView: MTKView) {
        if let descriptor = mtkView.currentRenderPassDescriptor, let drawable = mtkView.currentDrawable {
            let buffer = queue.makeCommandBuffer()
            let encoder = buffer?.makeRenderCommandEncoder(descriptor: descriptor)
            encoder?.setRenderPipelineState(pipeline)
            encoder?.endEncoding()
            buffer?.present(drawable)
            buffer?.commit()
        }
    }
}
