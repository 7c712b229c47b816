// The time slider: calls show(k) for frame k of those that frames.t gives the times of.
function player(frames, show) {
  const box = document.querySelector('.player');
  const button = box.querySelector('button'), slider = box.querySelector('[type=range]');
  const time = box.querySelector('output');
  const seconds = 8, last = frames.t.length - 1;
  const span = frames.t[last] - frames.t[0] || 1;
  const digits = Math.min(9, Math.max(0, 2 - Math.floor(Math.log10(span))));

  function paint(k) {
    show(k);
    time.textContent = 't = ' + frames.t[k].toFixed(digits) + ' s';
    slider.setAttribute('aria-valuetext', time.textContent);
  }

  let playing = false, start = 0;
  function tick(now) {
    if (!playing) return;
    const k = Math.floor((now - start) / 1000 / seconds * last);
    slider.value = Math.min(k, last);
    paint(+slider.value);
    if (k >= last) toggle(); else requestAnimationFrame(tick);
  }
  function toggle() {
    playing = !playing;
    button.textContent = playing ? 'Pause' : 'Play';
    if (!playing) return;
    if (+slider.value >= last) slider.value = 0;
    start = performance.now() - slider.value / last * seconds * 1000;
    requestAnimationFrame(tick);
  }
  button.addEventListener('click', toggle);
  slider.addEventListener('input', () => { if (playing) toggle(); paint(+slider.value); });
  slider.max = last;
  slider.value = frames.start;
  box.hidden = false;
  paint(frames.start);
}
