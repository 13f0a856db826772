// Four samples in a texture whose type has one.
import Metal

final class Shadow {
    private(set) var map: MTLTexture?

    func build(device: MTLDevice, side: Int) {
        let d = MTLTextureDescriptor.texture2DDescriptor(pixelFormat: .depth32Float, width: side, height: side, mipmapped: false)
        d.sampleCount = 4  // expect: MSAA811
        d.usage = [.renderTarget]
        d.storageMode = .private
        map = device.makeTexture(descriptor: d)
    }
}
