// A texture manager with a setting for multisampling, which stores the samples as well.
import Metal

enum TextureError: Error { case colour, samples }

public final class TextureManager {
    private let colorTexture: MTLTexture
    private var msaaColorTexture: MTLTexture?
    public let renderPassDescriptor: MTLRenderPassDescriptor

    public init(device: MTLDevice, sampleCount: Int = 4) throws {
        let colorDesc = MTLTextureDescriptor.texture2DDescriptor(pixelFormat: .bgra8Unorm, width: 1920, height: 1080, mipmapped: false)
        colorDesc.usage = [.renderTarget, .shaderRead]
        colorDesc.storageMode = .private
        guard let colorTex = device.makeTexture(descriptor: colorDesc) else { throw TextureError.colour }
        self.colorTexture = colorTex

        if sampleCount > 1 {
            let msaaDesc = MTLTextureDescriptor()
            msaaDesc.textureType = .type2DMultisample
            msaaDesc.pixelFormat = .bgra8Unorm
            msaaDesc.width = 1920
            msaaDesc.height = 1080
            msaaDesc.sampleCount = sampleCount
            msaaDesc.usage = .renderTarget
            msaaDesc.storageMode = .private
            guard let msaaTex = device.makeTexture(descriptor: msaaDesc) else { throw TextureError.samples }
            msaaColorTexture = msaaTex
        }

        let rpd = MTLRenderPassDescriptor()
        rpd.colorAttachments[0].loadAction = .clear
        if sampleCount > 1 {
            rpd.colorAttachments[0].texture = msaaColorTexture
            rpd.colorAttachments[0].resolveTexture = colorTexture
            rpd.colorAttachments[0].storeAction = .storeAndMultisampleResolve  // expect: MSAA801
        } else {
            rpd.colorAttachments[0].texture = colorTexture
            rpd.colorAttachments[0].storeAction = .store
        }
        self.renderPassDescriptor = rpd
    }

    public static func fullHD(device: MTLDevice) throws -> TextureManager {
        try TextureManager(device: device, sampleCount: 4)
    }
}
