-- What a measurement needs inside Luanti. Settings:
--   compare_mode = generate | load | view
--   compare_boxes = x0,y0,z0,x1,y1,z1;...  blocks, ends included, borders of mapchunks (generate, load)
--   compare_heights = true                 write the heights of the ground into heights.txt of the world (generate)
-- Files in the folder of the world (view): camera.txt has "x y z yaw pitch fps", in degrees, pitch down, and at most so many
-- frames a second; it is read twice a second.
local settings, world = minetest.settings, minetest.get_worldpath()
local mode = settings:get("compare_mode")
local kMapchunk, kCell = 80, 8  -- blocks

local function report(values) print("COMPARE " .. minetest.write_json(values)) end

local function boxes()
  local list = {}
  for box in (settings:get("compare_boxes") or ""):gmatch("[^;]+") do
    local n = {}
    for number in box:gmatch("-?%d+") do n[#n + 1] = tonumber(number) end
    list[#list + 1] = {vector.new(n[1], n[2], n[3]), vector.new(n[4], n[5], n[6])}
  end
  return list
end

-- Calls `take(from, to)` for each mapchunk of a box.
local function each_mapchunk(box, take)
  for z = box[1].z, box[2].z, kMapchunk do
    for x = box[1].x, box[2].x, kMapchunk do
      for y = box[1].y, box[2].y, kMapchunk do
        local from = vector.new(x, y, z)
        take(from, vector.add(from, kMapchunk - 1))
      end
    end
  end
end

-- generate: one block of each mapchunk is enough. load: all blocks.
local function emerge_all()
  local waiting, counts, parts = 1, {}, 0
  local names = {[minetest.EMERGE_CANCELLED] = "cancelled", [minetest.EMERGE_ERRORED] = "errored",
                 [minetest.EMERGE_FROM_MEMORY] = "memory", [minetest.EMERGE_FROM_DISK] = "disk",
                 [minetest.EMERGE_GENERATED] = "generated"}
  local begin, cpu_begin = minetest.get_us_time(), os.clock()
  local function finish()
    report({seconds = (minetest.get_us_time() - begin) / 1e6, cpu_begin = cpu_begin, cpu_end = os.clock(), counts = counts,
            mapchunks = parts})
    minetest.request_shutdown()
  end
  local function is_done(_, action, remaining)
    counts[names[action]] = (counts[names[action]] or 0) + 1
    if remaining == 0 then
      waiting = waiting - 1
      if waiting == 0 then finish() end
    end
  end
  for _, box in ipairs(boxes()) do
    each_mapchunk(box, function(from, to)
      waiting, parts = waiting + 1, parts + 1
      local middle = vector.add(from, 32)
      if mode == "load" then minetest.emerge_area(from, to, is_done) else minetest.emerge_area(middle, middle, is_done) end
    end)
  end
  waiting = waiting - 1
  if waiting == 0 then finish() end
end

-- Lines "x z height": the least height of the ground in a cell, by which trees and single rocks do not count.
local function record_heights()
  local file = assert(io.open(world .. "/heights.txt", "a"))
  minetest.register_on_generated(function(from)
    local heights = minetest.get_mapgen_object("heightmap")
    if not heights then return end
    for z = 0, kMapchunk - 1, kCell do
      for x = 0, kMapchunk - 1, kCell do
        local least = 32767
        for dz = 0, kCell - 1 do
          for dx = 0, kCell - 1 do least = math.min(least, heights[(z + dz) * kMapchunk + x + dx + 1]) end
        end
        file:write(from.x + x, " ", from.z + z, " ", least, "\n")
      end
    end
  end)
  minetest.register_on_shutdown(function() file:close() end)
end

local function camera()
  local file = io.open(world .. "/camera.txt", "r")
  local numbers = {}
  if file then
    for word in file:read("*a"):gmatch("%S+") do numbers[#numbers + 1] = tonumber(word) end
    file:close()
  end
  return #numbers == 6 and numbers or nil
end

local function follow_camera(player)
  local at = camera()
  if at and player:get_pos() then
    local pos = vector.new(at[1], at[2], at[3])
    if vector.distance(player:get_pos(), pos) > 0.2 then player:set_pos(pos) end
    player:set_look_horizontal(math.rad(at[4]))
    player:set_look_vertical(math.rad(at[5]))
    -- The client in the same process reads them for each frame.
    settings:set("fps_max", at[6])
    settings:set("fps_max_unfocused", at[6])
  end
  if player:get_pos() then minetest.after(0.5, follow_camera, player) end
end

if mode == "view" then
  minetest.register_on_joinplayer(function(player)
    minetest.set_timeofday(0.5)
    player:set_physics_override({gravity = 0, speed = 0, jump = 0})
    follow_camera(player)
  end)
else
  if settings:get_bool("compare_heights") then record_heights() end
  minetest.after(1, emerge_all)
end
