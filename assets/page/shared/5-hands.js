// Mouse and fingers on a picture.

/**
 * Drags turn the camera, wheel and pinch zoom.
 * @param takeOver told of a drag with one pointer, in pixels; true: it is not to turn
 */
function watchHands(stage, camera, redraw, {farthest = 12, takeOver = () => false} = {}) {
  const pointers = new Map();
  const zoomBy = (factor) => { camera.zoom = Math.min(Math.max(camera.zoom * factor, 0.3), farthest); };
  stage.addEventListener("pointerdown", (event) => {
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    stage.setPointerCapture(event.pointerId);
  });
  stage.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY];
    const by = [now[0] - before[0], now[1] - before[1]];
    if (pointers.size === 2) {
      const [other] = [...pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
      const apart = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
      zoomBy(apart(now) / Math.max(apart(before), 1));
    } else if (!takeOver(event, by)) {
      const turn = 5.5 / Math.max(stage.clientWidth, 200);
      camera.turn(by[0] * turn, by[1] * turn);
    }
    pointers.set(event.pointerId, now);
    redraw();
  });
  for (const end of ["pointerup", "pointercancel"]) {
    stage.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }
  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoomBy(Math.exp(-0.0014 * event.deltaY));
    redraw();
  }, {passive: false});
}

/** Shift and the arrows do what drags do, for who has no mouse. True if the key was one of them. */
function turnByKey(event, camera) {
  const turns = {ArrowLeft: [-0.12, 0], ArrowRight: [0.12, 0], ArrowUp: [0, -0.12], ArrowDown: [0, 0.12]};
  if (!event.shiftKey || !turns[event.key]) return false;
  camera.turn(...turns[event.key]);
  event.preventDefault();
  return true;
}
