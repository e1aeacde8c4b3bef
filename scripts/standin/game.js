'use strict'
// A superflat Minecraft 1.18.2 world by flying-squid: a stone floor at y = 4, eternal noon, one player in creative mode.

const { createMCServer } = require('flying-squid')
const { Vec3 } = require('vec3')
const { addVanillaCommands } = require('./commands')

const VERSION = '1.18.2'
const FLOOR_Y = 4
const FLOOR = { from: -16, to: 31 } // blocks along x and z: the chunks that the client loads first
const SPAWN = new Vec3(8.5, FLOOR_Y + 1, 8.5)

async function startGame () {
  const { blocksByName } = require('minecraft-data')(VERSION)
  const stone = blocksByName.stone.id
  const game = createMCServer({
    host: '127.0.0.1',
    port: 0,
    version: VERSION,
    'online-mode': false,
    'everybody-op': true,
    'max-players': 1,
    'max-entities': 10,
    'view-distance': 2,
    motd: 'stand-in',
    gameMode: 1,
    difficulty: 0,
    kickTimeout: 10000,
    logging: false,
    plugins: {},
    'player-list-text': { header: { text: '' }, footer: { text: '' } },
    generation: { name: 'superflat', options: { bottomId: blocksByName.bedrock.id, middleId: stone, topId: stone, middleThickness: 3 } }
  })
  addVanillaCommands(game)
  introduceEachPlayerToItself(game)
  await game.waitForReady(20000)
  game.getSpawnPoint = async () => SPAWN.clone()
  game.doDaylightCycle = false
  game.setTime(6000)
  await layFloor(game, blocksByName.stone.defaultState)
  return game
}

// The generator turns the top layer into another kind of stone: data 0, plain stone, counts as "not given" there.
async function layFloor (game, stone) {
  for (let x = FLOOR.from; x <= FLOOR.to; x++) {
    for (let z = FLOOR.from; z <= FLOOR.to; z++) await game.overworld.setBlockStateId(new Vec3(x, FLOOR_Y, z), stone)
  }
}

// flying-squid tells a player about all others only; without itself in its list, the client stops at /gamemode for good.
function introduceEachPlayerToItself (game) {
  game.on('newPlayer', player => player.on('spawned', () => setTimeout(() => player._client.write('player_info', {
    action: 'add_player',
    data: [{ uuid: player.uuid, name: player.username, properties: [], gamemode: player.gameMode, ping: 1 }]
  }), 500)))
}

module.exports = { startGame }
