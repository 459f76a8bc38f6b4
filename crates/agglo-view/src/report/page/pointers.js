// Mouse and fingers on the stage: drag turns, wheel and pinch zoom, shift or the right button and drag moves, a click picks.

// `changed(byHand)` is called after the camera moved, `picked(event)` at a click.
function followPointers(canvas, camera, changed, picked) {
  const fingers = new Map();
  let traveled = 0;
  canvas.addEventListener("pointerdown", (event) => {
    fingers.set(event.pointerId, event);
    canvas.setPointerCapture(event.pointerId);
    traveled = 0;
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const [dx, dy] = [event.clientX - before.clientX, event.clientY - before.clientY];
    traveled += Math.hypot(dx, dy);
    const other = [...fingers.values()].find((finger) => finger.pointerId !== event.pointerId);
    let moved = true;
    if (other) camera.zoom(spread(before, other) / Math.max(spread(event, other), 1));
    else if (event.shiftKey || event.buttons === 2) camera.move(dx / canvas.clientHeight, -dy / canvas.clientHeight);
    else {
      camera.turn(dx * 0.008, dy * 0.008);
      moved = false;
    }
    fingers.set(event.pointerId, event);
    changed(moved);
  });
  const lift = (event) => {
    if (fingers.delete(event.pointerId) && event.type === "pointerup" && traveled < 5) picked(event);
  };
  canvas.addEventListener("pointerup", lift);
  canvas.addEventListener("pointercancel", lift);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    // The page scrolls past a stage that nobody has touched.
    if (document.activeElement !== canvas) return;
    event.preventDefault();
    camera.zoom(Math.exp(0.001 * event.deltaY));
    changed(true);
  }, { passive: false });
}

function spread(a, b) {
  return Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
}
