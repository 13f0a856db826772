import QtQuick

Rectangle {
    width: 640
    height: 360
    color: "navy"

    Rectangle {
        anchors.centerIn: parent
        width: 200
        height: 200
        color: "orange"
        antialiasing: true
        NumberAnimation on rotation { from: 0; to: 360; duration: 2000; loops: -1 }
    }

    Item {
        width: 160
        height: 160
        layer.enabled: true
        layer.samples: 4
        Rectangle {
            width: 100
            height: 100
            rotation: 20
            color: "red"
            NumberAnimation on x { from: 0; to: 50; duration: 500; loops: -1 }
        }
    }
}
