'use strict'
// Runs in the page, before the client: says what the screen shows, and which errors came, whenever that changes.
;(() => {
  const SLOW_FRAME_MS = 200
  let errors = []
  let last = ''
  window.addEventListener('error', event => errors.push(String(event.message)))
  window.addEventListener('unhandledrejection', event => errors.push(String(event.reason)))

  // A key that is pressed and released between two frames never happened for this client, and while it draws the world for
  // the first time, frames can be more than a second apart. Steady: in the last second none took too long.
  let lastFrame = performance.now()
  let lastSlowFrame = lastFrame
  function frame (now) {
    if (now - lastFrame > SLOW_FRAME_MS) lastSlowFrame = now
    lastFrame = now
    requestAnimationFrame(frame)
  }
  requestAnimationFrame(frame)

  function isSteady () {
    const now = performance.now()
    return now - lastFrame < SLOW_FRAME_MS && now - lastSlowFrame > 1000
  }

  function screen () {
    const hud = document.getElementById('hud')
    const loading = document.getElementById('loading-screen')
    const part = name => hud?.shadowRoot?.querySelector(name)
    return {
      playing: hud?.style.display === 'block' && loading?.style.display === 'none',
      overlay: part('#debug-overlay')?.showOverlay === true,
      chat: part('#chat')?.inChat === true,
      pointer_locked: document.pointerLockElement !== null,
      focused: document.hasFocus(),
      steady: isSteady(),
      error_screen: loading?.hasError ? loading.status : null
    }
  }

  setInterval(() => {
    const body = JSON.stringify({ ...screen(), errors })
    if (body === last) return
    last = errors.length ? '' : body
    errors = []
    fetch('/report', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body })
  }, 100)
})()
