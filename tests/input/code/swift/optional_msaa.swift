// Multisampling by a setting, memoryless where the platform has it: nothing to report.
import Metal

public class RenderTarget {
    public var sampleCount: Int = 1 {
        didSet { rebuild() }
    }
    private let device: MTLDevice
    private var colorTexture: MTLTexture?
    private var msaaTexture: MTLTexture?
    private var depthTexture: MTLTexture?
    private var size = MTLSize(width: 1, height: 1, depth: 1)

    public init(device: MTLDevice) {
        self.device = device
    }

    private func rebuild() {
        let color = MTLTextureDescriptor.texture2DDescriptor(
            pixelFormat: .rgba16Float, width: size.width, height: size.height, mipmapped: false)
        color.usage = [.renderTarget, .shaderRead]
        color.storageMode = .private
        colorTexture = device.makeTexture(descriptor: color)

        let msaa = MTLTextureDescriptor.texture2DDescriptor(
            pixelFormat: .rgba16Float, width: size.width, height: size.height, mipmapped: false)
        msaa.usage = .renderTarget
        if sampleCount > 1 {
            msaa.textureType = .type2DMultisample
            msaa.sampleCount = sampleCount
            #if os(iOS) || os(tvOS)
            msaa.storageMode = .memoryless
            #else
            msaa.storageMode = .private
            #endif
            msaaTexture = device.makeTexture(descriptor: msaa)
        } else {
            msaaTexture = nil
        }

        let depth = MTLTextureDescriptor.texture2DDescriptor(
            pixelFormat: .depth32Float, width: size.width, height: size.height, mipmapped: false)
        depth.textureType = sampleCount > 1 ? .type2DMultisample : .type2D
        depth.sampleCount = sampleCount
        depth.usage = .renderTarget
        #if os(iOS) || os(tvOS)
        depth.storageMode = .memoryless
        #else
        depth.storageMode = .private
        #endif
        depthTexture = device.makeTexture(descriptor: depth)
    }

    func passDescriptor() -> MTLRenderPassDescriptor {
        let pass = MTLRenderPassDescriptor()
        if let msaaTexture {
            pass.colorAttachments[0].texture = msaaTexture
            pass.colorAttachments[0].resolveTexture = colorTexture
            pass.colorAttachments[0].storeAction = .multisampleResolve
        } else {
            pass.colorAttachments[0].texture = colorTexture
            pass.colorAttachments[0].storeAction = .store
        }
        pass.colorAttachments[0].loadAction = .clear
        pass.depthAttachment.texture = depthTexture
        pass.depthAttachment.loadAction = .clear
        pass.depthAttachment.storeAction = .dontCare
        return pass
    }
}
