// swift-tools-version:5.9
import PackageDescription

let package = Package(name: "Engine", targets: [.target(name: "Engine"), .target(name: "Viewer", dependencies: ["Engine"])])
