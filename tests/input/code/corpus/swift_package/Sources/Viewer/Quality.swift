// Another module may use the same name for something else.
enum Quality {
    static let samples = 1
}
