// A playground: the view gets four samples when the switch is on, but the terrain keeps the pipeline of one sample.
import MetalKit

final class Playground: NSObject, MTKViewDelegate {
    let device: MTLDevice
    let commandQueue: MTLCommandQueue
    var terrainState: MTLRenderPipelineState!
    var treeState: MTLRenderPipelineState!
    var treeStateAA: MTLRenderPipelineState!
    var antialiasingEnabled = true

    init(view: MTKView) {
        device = MTLCreateSystemDefaultDevice()!
        commandQueue = device.makeCommandQueue()!
        super.init()
        view.device = device
        view.depthStencilPixelFormat = .depth32Float
        view.sampleCount = antialiasingEnabled ? 4 : 1
        view.delegate = self
        buildPipelines()
    }

    func buildPipelines() {
        do {
            let descriptor = MTLRenderPipelineDescriptor()  // expect: MSAA810
            descriptor.colorAttachments[0].pixelFormat = .bgra8Unorm
            descriptor.depthAttachmentPixelFormat = .depth32Float
            terrainState = try device.makeRenderPipelineState(descriptor: descriptor)
            descriptor.fragmentFunction = nil
            treeState = try device.makeRenderPipelineState(descriptor: descriptor)
            descriptor.sampleCount = 4
            treeStateAA = try device.makeRenderPipelineState(descriptor: descriptor)
        } catch {
            fatalError(error.localizedDescription)
        }
    }

    func mtkView(_ view: MTKView, drawableSizeWillChange size: CGSize) {}

    func draw(in view: MTKView) {
        guard let descriptor = view.currentRenderPassDescriptor,
              let commandBuffer = commandQueue.makeCommandBuffer(),
              let encoder = commandBuffer.makeRenderCommandEncoder(descriptor: descriptor),
              let drawable = view.currentDrawable else { return }
        encoder.setRenderPipelineState(terrainState)
        encoder.drawPrimitives(type: .triangle, vertexStart: 0, vertexCount: 6)
        encoder.setRenderPipelineState(antialiasingEnabled ? treeStateAA : treeState)
        encoder.drawPrimitives(type: .triangle, vertexStart: 0, vertexCount: 36)
        encoder.endEncoding()
        commandBuffer.present(drawable)
        commandBuffer.commit()
    }
}
