// Redraws the profiles of the figure and the block beside them.
(() => {
  const frames = JSON.parse(document.getElementById('frames').textContent);
  const plot = document.querySelector('#profiles .plot');
  const curves = plot.querySelectorAll('path'), solid = plot.querySelector('.band');
  const [x0, x1, y0, y1] = plot.dataset.range.split(' ').map(Number);
  const width = plot.width.baseVal.value, height = plot.height.baseVal.value;
  const across = x => (x - x0) / (x1 - x0) * width;
  const up = y => (y1 - y) / (y1 - y0) * height;
  player(frames, k => {
    frames.models.forEach((model, m) => {
      const v = model[k] || [];
      curves[m].setAttribute('d', v.map((q, i) =>
        (i ? 'L' : 'M') + across(frames.x[i]).toFixed(1) + ' ' + up(q * frames.unit).toFixed(1)).join(''));
    });
    const face = across(frames.position[k]);
    solid.setAttribute('x', face);
    solid.setAttribute('width', Math.max(0, width - face));
  });
})();
