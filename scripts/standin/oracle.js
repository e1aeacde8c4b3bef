'use strict'
// What the server knows, as JSON over HTTP on 127.0.0.1: the world is read here, never from the client.
//   GET /player                           {"position": [x, y, z], "yaw", "pitch", "slot", "held": {"name", "count"} | null}, or 404
//   GET /blocks?from=x,y,z&to=x,y,z       [{"pos": [x, y, z], "name"}]: every block that is not air, both corners included
//   GET /screen                           what the page says it shows, and null before it does
//   GET /errors                           ["...", ...]: errors of the page since the start

const http = require('http')
const { Vec3 } = require('vec3')
const { placesBetween } = require('./commands')

const MOST_BLOCKS = 1000000
const DEGREES_A_BYTE = 360 / 256 // the server keeps looks as 256ths of a turn

function startOracle (game, screen) {
  const answers = {
    '/player': () => playerOf(game),
    '/blocks': query => blocksOf(game, corner(query.get('from')), corner(query.get('to'))),
    '/screen': () => screen.report,
    '/errors': () => screen.errors
  }
  const server = http.createServer(async (request, response) => {
    const { pathname, searchParams } = new URL(request.url, 'http://127.0.0.1')
    let [status, body] = [404, { error: `ask for one of ${Object.keys(answers).join(' ')}` }]
    try {
      if (answers[pathname]) [status, body] = [200, await answers[pathname](searchParams)]
    } catch (error) {
      [status, body] = [error.status ?? 500, { error: error.message }]
    }
    response.writeHead(status, { 'Content-Type': 'application/json' }).end(JSON.stringify(body))
  })
  return new Promise((resolve, reject) => server.on('error', reject).listen(0, '127.0.0.1', () => resolve(server)))
}

const refusal = (status, message) => Object.assign(new Error(message), { status })

function playerOf (game) {
  const player = game.players[0]
  if (!player) throw refusal(404, 'no player has joined')
  const held = player.inventory.slots[36 + player.heldItemSlot]
  return {
    position: player.position.toArray(),
    yaw: player.yaw * DEGREES_A_BYTE,
    pitch: player.pitch * DEGREES_A_BYTE,
    slot: player.heldItemSlot,
    held: held ? { name: held.name, count: held.count } : null
  }
}

function corner (text) {
  const numbers = (text ?? '').split(',').map(Number)
  if (numbers.length !== 3 || !numbers.every(Number.isInteger)) throw refusal(400, 'from and to are three whole numbers: x,y,z')
  return new Vec3(...numbers)
}

async function blocksOf (game, from, to) {
  const [low, high] = [from.min(to), from.max(to)]
  if (high.minus(low).offset(1, 1, 1).volume() > MOST_BLOCKS) throw refusal(400, `at most ${MOST_BLOCKS} blocks at once`)
  const found = []
  for (const place of placesBetween(low, high)) {
    const block = await game.overworld.getBlock(place)
    if (!/(^|_)air$/.test(block.name)) found.push({ pos: place.toArray(), name: block.name })
  }
  return found
}

module.exports = { startOracle }
