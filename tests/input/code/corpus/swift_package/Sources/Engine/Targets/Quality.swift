enum Quality {
    static let samples = 4
}
