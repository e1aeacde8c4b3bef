'use strict'

// The text with each [from, to] applied; an error where a from is not there exactly once, for then the text is another version's.
function patchedOnce (text, patches) {
  for (const [from, to] of patches) {
    const times = text.split(from).length - 1
    if (times !== 1) throw new Error(`a patch of the web client matches ${times} times instead of once: ${from}`)
    text = text.replace(from, () => to)
  }
  return text
}

module.exports = { patchedOnce }
