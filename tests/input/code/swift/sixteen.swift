// Sixteen samples, which no device has.
import Metal

enum Quality: Int {
    case off = 1
    case best = 16
}

func makeOffscreen(device: MTLDevice) -> MTLTexture? {
    let desc = MTLTextureDescriptor()
    desc.textureType = .type2DMultisample
    desc.pixelFormat = .rgba16Float
    desc.width = 2048
    desc.height = 2048
    desc.sampleCount = Quality.best.rawValue  // expect: MSAA809
    desc.usage = [.renderTarget]
    desc.resourceOptions = .storageModePrivate
    let texture = device.makeTexture(descriptor: desc)
    texture?.label = "offscreen"
    return texture
}
