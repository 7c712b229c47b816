// Swaps the pictures of the three views, and moves the bodies over them.
(() => {
  const frames = JSON.parse(document.getElementById('frames').textContent);
  const views = frames.views.map(({ name, pictures }) => {
    const figure = document.getElementById(name), plot = figure.querySelector('.plot');
    return { figure, plot, pictures, image: plot.querySelector('image'), solids: plot.querySelectorAll('.solid') };
  });
  let view = views[0], frame = frames.start;

  function show(k) {
    frame = k;
    const { plot, image, solids, pictures } = view;
    const picture = new Image();
    picture.src = 'data:image/png;base64,' + pictures[k];
    // Only when it is decoded, so that nothing flickers.
    picture.decode().then(() => { if (frame === k) image.setAttribute('href', picture.src); }, () => {});
    const [x0, x1, y0, y1] = plot.dataset.range.split(' ').map(Number);
    const across = x => (x - x0) / (x1 - x0) * plot.width.baseVal.value;
    const up = y => (y1 - y) / (y1 - y0) * plot.height.baseVal.value;
    frames.bodies.forEach((track, b) => {
      if (!track) return;
      const [x, y, degrees] = track[k];
      solids[b].setAttribute('transform', `translate(${across(x)} ${up(y)}) rotate(${-degrees})`);
    });
  }
  function choose(name) {
    view = views.find(({ figure }) => figure.id === name);
    views.forEach(({ figure }) => { figure.hidden = figure.id !== name; });
    show(frame);
  }
  const radios = [...document.querySelectorAll('.player [type=radio]')];
  radios.forEach(radio => radio.addEventListener('change', () => choose(radio.value)));
  player(frames, show);
  choose((radios.find(radio => radio.checked) || radios[0]).value);
})();
