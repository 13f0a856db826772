// The base class renders with one sample, but subclasses override its count: nothing to report.
import Metal

open class Renderer {
    open var sampleCount: Int { 1 }
    public let device: MTLDevice

    public init(device: MTLDevice) {
        self.device = device
    }

    open func makeColor(width: Int, height: Int) -> MTLTexture? {
        let descriptor = MTLTextureDescriptor()
        descriptor.width = width
        descriptor.height = height
        descriptor.textureType = .type2DMultisample
        descriptor.sampleCount = sampleCount
        descriptor.usage = .renderTarget
        return device.makeTexture(descriptor: descriptor)
    }
}
