function love.conf(t)
  t.window.width, t.window.height, t.window.msaa, t.window.vsync, t.window.depth = 640, 360, 4, 0, 24
  t.modules.audio, t.modules.sound, t.modules.joystick, t.modules.physics = false, false, false, false
end
