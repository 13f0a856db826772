// A shadow map and a picture of one sample a pixel: nothing to report.
import Metal
import UIKit

struct Textures {
    var shadow: MTLTexture
    var picture: MTLTexture

    init(_ device: MTLDevice) {
        let d = MTLTextureDescriptor.texture2DDescriptor(pixelFormat: .depth32Float, width: 2048, height: 2048, mipmapped: false)
        d.usage = [.renderTarget, .shaderRead]
        d.storageMode = .private
        shadow = device.makeTexture(descriptor: d)!
        d.pixelFormat = .rgba8Unorm
        d.usage.insert(.shaderWrite)
        picture = device.makeTexture(descriptor: d)!
    }
}

func shadowPass(_ textures: Textures) -> MTLRenderPassDescriptor {
    let pass = MTLRenderPassDescriptor()
    pass.depthAttachment.texture = textures.shadow
    pass.depthAttachment.loadAction = .clear
    pass.depthAttachment.storeAction = .store
    return pass
}
