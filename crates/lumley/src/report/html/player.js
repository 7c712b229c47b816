// The time slider: redraws the curves of the figure before it from the frames beside it.
(() => {
  const player = document.querySelector('.player');
  const frames = JSON.parse(document.getElementById('frames').textContent);
  const plot = document.querySelector('#profiles .plot');
  const curves = plot.querySelectorAll('path'), solid = plot.querySelector('.band');
  const [button, slider, time] = player.querySelectorAll('button, input, output');
  const [x0, x1, y0, y1] = plot.dataset.range.split(' ').map(Number);
  const width = plot.width.baseVal.value, height = plot.height.baseVal.value;
  const across = x => (x - x0) / (x1 - x0) * width;
  const up = y => (y1 - y) / (y1 - y0) * height;

  function show(k) {
    frames.models.forEach((model, m) => {
      const v = model[k] || [];
      curves[m].setAttribute('d', v.map((q, i) =>
        (i ? 'L' : 'M') + across(frames.x[i]).toFixed(1) + ' ' + up(q * frames.unit).toFixed(1)).join(''));
    });
    const face = across(frames.position[k]);
    solid.setAttribute('x', face);
    solid.setAttribute('width', Math.max(0, width - face));
    time.textContent = 't = ' + frames.t[k].toFixed(2) + ' s';
    slider.setAttribute('aria-valuetext', time.textContent);
  }

  let playing = false, start = 0;
  const seconds = 8, last = frames.t.length - 1;
  function tick(now) {
    if (!playing) return;
    const k = Math.floor((now - start) / 1000 / seconds * last);
    slider.value = Math.min(k, last);
    show(+slider.value);
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
  slider.addEventListener('input', () => { if (playing) toggle(); show(+slider.value); });
  slider.max = last;
  slider.value = frames.start;
  player.hidden = false;
  show(frames.start);
})();
