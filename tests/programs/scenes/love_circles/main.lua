local canvas, frames = nil, 0
function love.load() canvas = love.graphics.newCanvas(256, 256, { msaa = 4 }) end
function love.update() frames = frames + 1 if frames > 6 then love.event.quit() end end
function love.draw()
  love.graphics.setCanvas(canvas)
  love.graphics.clear(0, 0, 0, 1)
  love.graphics.circle("fill", 128, 128, 100)
  love.graphics.setCanvas()
  love.graphics.draw(canvas, 20, 20)
  love.graphics.circle("fill", 480, 180, 20 * frames)
end
