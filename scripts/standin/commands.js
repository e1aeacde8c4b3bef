'use strict'
// The commands that the agent types, in the syntax of Minecraft 1.17 and later. A returned string is shown in red.

const { Vec3 } = require('vec3')

const MOST_BLOCKS = 32768 // of one /fill, as in the game
const RELATIVE_LOOK = 0x18 // flags of the position packet: yaw and pitch are added to the player's own
const GAME_MODES = { survival: 0, creative: 1, adventure: 2, spectator: 3 }
const TIMES = { day: 1000, noon: 6000, night: 13000, midnight: 18000 }
const plainName = id => id.replace(/^minecraft:/, '')
const isMe = word => word === undefined || word === '@s' || word === '@p' || word === '@a'

function addVanillaCommands (game) {
  const Item = require('prismarine-item')(game.registry)
  const { blocksByName, itemsByName } = game.registry

  const add = (base, usage, action) => game.commands.add({
    base,
    info: usage,
    usage,
    op: true,
    onlyPlayer: true,
    parse: text => text.trim().split(/\s+/).filter(word => word !== ''),
    action: (words, { player }) => action(words, player)
  })

  add('fill', '/fill x y z x y z block [replace]', async (words, player) => {
    const corners = [blockAt(words.slice(0, 3), player), blockAt(words.slice(3, 6), player)]
    const block = blocksByName[plainName(words[6] ?? '')]
    if (corners.includes(null)) return 'Incomplete or wrong coordinates'
    if (!block) return `Unknown block type '${words[6]}'`
    if (words[7] !== undefined && words[7] !== 'replace') return `Unknown mode '${words[7]}'`
    const [low, high] = [corners[0].min(corners[1]), corners[0].max(corners[1])]
    const size = high.minus(low).offset(1, 1, 1)
    if (size.volume() > MOST_BLOCKS) return `Too many blocks in the specified area (maximum ${MOST_BLOCKS}, specified ${size.volume()})`
    for (const place of placesBetween(low, high)) {
      if (await player.world.getBlockStateId(place) !== block.defaultState) await game.setBlock(player.world, place, block.defaultState)
    }
  })

  add('tp', '/tp [@s] x y z [yaw pitch]', (words, player) => {
    const numbers = words[0] === '@s' ? words.slice(1) : words
    const place = numbers.slice(0, 3).map((word, axis) => coordinate(word, player.position.toArray()[axis], axis !== 1))
    const look = numbers.slice(3, 5).map(Number)
    if (![3, 5].includes(numbers.length) || [...place, ...look].some(Number.isNaN)) return 'Incomplete or wrong coordinates'
    player.position = new Vec3(...place)
    player.knownPosition = player.position
    const [yaw, pitch] = look.length ? look : [0, 0]
    const flags = look.length ? 0 : RELATIVE_LOOK
    player._client.write('position', { ...player.position, yaw, pitch, flags, teleportId: 1, dismountVehicle: false })
  })

  add('item', '/item replace entity @s hotbar.N with item [count]', (words, player) => {
    const [verb, kind, who, slot, joint, id, count = '1'] = words
    const number = /^hotbar\.([0-8])$/.exec(slot)?.[1]
    const item = itemsByName[plainName(id ?? '')]
    if (verb !== 'replace' || kind !== 'entity' || who !== '@s' || joint !== 'with') return 'Incorrect argument for command'
    if (number === undefined) return `Unknown slot '${slot}'`
    if (!item) return `Unknown item '${id}'`
    if (!(+count >= 1 && +count <= item.stackSize)) return `Wrong count '${count}'`
    player.inventory.updateSlot(36 + +number, new Item(item.id, +count))
  })

  add('clear', '/clear [@s]', ([who], player) => {
    if (!isMe(who)) return 'No player was found'
    player.inventory.slots.forEach((item, slot) => { if (item) player.inventory.updateSlot(slot, null) })
  })

  add('gamemode', '/gamemode survival|creative|adventure|spectator [@s]', ([mode, who], player) => {
    if (GAME_MODES[mode] === undefined || !isMe(who)) return 'Incorrect argument for command'
    player.setGameMode(GAME_MODES[mode])
  })

  add('time', '/time set day|noon|night|midnight|NUMBER', ([verb, time]) => {
    const ticks = TIMES[time] ?? Number(time)
    if (verb !== 'set' || !Number.isInteger(ticks)) return 'Incorrect argument for command'
    game.setTime(ticks)
  })

  // Of the game's rules this server knows one; the others, and the weather, are taken and change nothing.
  add('gamerule', '/gamerule rule value', ([rule, value]) => {
    if (rule === undefined || value === undefined) return 'Incorrect argument for command'
    if (rule === 'doDaylightCycle') game.doDaylightCycle = value === 'true'
  })
  add('weather', '/weather clear|rain|thunder', ([weather]) => {
    if (!['clear', 'rain', 'thunder'].includes(weather)) return 'Incorrect argument for command'
  })
}

// A word of a command as a number: "~" and "~1.5" from where the player is, a whole x or z is the middle of its block.
function coordinate (word, from, middle) {
  if (/^~/.test(word)) return from + Number(word.slice(1))
  return middle && /^-?\d+$/.test(word) ? Number(word) + 0.5 : word === '' ? NaN : Number(word)
}

function blockAt (words, player) {
  const place = new Vec3(...words.map((word, axis) => coordinate(word, player.position.toArray()[axis], false))).floored()
  return words.length === 3 && !place.toArray().some(Number.isNaN) ? place : null
}

function * placesBetween (low, high) {
  for (let y = low.y; y <= high.y; y++) {
    for (let z = low.z; z <= high.z; z++) {
      for (let x = low.x; x <= high.x; x++) yield new Vec3(x, y, z)
    }
  }
}

module.exports = { addVanillaCommands, placesBetween }
