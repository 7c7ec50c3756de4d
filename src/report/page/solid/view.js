// A wall in three dimensions: its blocks as they are, to be turned, drawn near, and moved from rest to the mechanism.
// solid.min.js is made of this by build.sh.
import {
  AmbientLight, BufferGeometry, DirectionalLight, DoubleSide, EdgesGeometry, Float32BufferAttribute, LineBasicMaterial, LineSegments,
  Mesh, MeshLambertMaterial, PerspectiveCamera, Quaternion, Scene, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

// A block about its centroid. A face with n corners is a fan of n - 2 triangles, as it is convex.
function solid(block) {
  const at = (k) => [0, 1, 2].map((axis) => block.vertices[3 * k + axis] - block.centroid[axis]);
  const corners = block.faces.flatMap((face) => face.slice(2).flatMap((k, i) => [at(face[0]), at(face[i + 1]), at(k)]));
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(corners.flat(), 3));
  geometry.computeVertexNormals();
  const colour = block.still ? 0xcfc8b8 : 0x9aa2aa;
  const mesh = new Mesh(geometry, new MeshLambertMaterial({ color: colour, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
  mesh.add(new LineSegments(new EdgesGeometry(geometry, 1), new LineBasicMaterial({ color: 0x222222 })));
  return mesh;
}

// Takes a block so far along its movement, as a share of what is drawn.
function place(mesh, block, far) {
  mesh.position.fromArray(block.centroid).addScaledVector(new Vector3().fromArray(block.shift), far);
  const turn = new Vector3().fromArray(block.turn);
  const angle = turn.length() * far;
  mesh.quaternion.copy(new Quaternion().setFromAxisAngle(turn.normalize(), angle));
}

function show(figure) {
  const canvas = figure.querySelector("canvas");
  const slider = figure.querySelector("input");
  const { blocks, from_front } = JSON.parse(figure.querySelector("script").textContent);
  let renderer;
  try {
    renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
  } catch {
    figure.querySelector(".without").hidden = false;
    canvas.hidden = true;
    slider.disabled = true;
    return;
  }
  const scene = new Scene();
  const camera = new PerspectiveCamera(35, 1, 0.01, 1000);
  camera.up.set(0, 0, 1);
  const sun = new DirectionalLight(0xffffff, 2);
  const meshes = blocks.map(solid);
  scene.add(new AmbientLight(0xffffff, 1.2), sun, ...meshes);
  const low = new Vector3(Infinity, Infinity, Infinity), high = low.clone().negate();
  blocks.forEach((block) => {
    for (let k = 0; k < block.vertices.length; k += 3) {
      const corner = new Vector3().fromArray(block.vertices, k);
      low.min(corner);
      high.max(corner);
    }
  });
  const middle = low.clone().add(high).multiplyScalar(0.5);
  const size = Math.max(low.distanceTo(high), 1e-3);
  const side = from_front ? 1 : -1;
  camera.position.copy(middle).add(new Vector3(-0.6 * side, 1.3 * side, 0.6).multiplyScalar(0.9 * size));
  sun.position.set(-0.3 * side, 1 * side, 1.6);
  const controls = new OrbitControls(camera, canvas);
  controls.target.copy(middle);
  // Until it is chosen the wheel goes on through the page.
  controls.enableZoom = false;
  canvas.addEventListener("focus", () => { controls.enableZoom = true; });
  canvas.addEventListener("blur", () => { controls.enableZoom = false; });
  canvas.addEventListener("pointerdown", () => canvas.focus());
  controls.update();
  function draw() {
    const width = canvas.clientWidth, height = canvas.clientHeight;
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setSize(width, height, false);
    renderer.setClearColor(0xffffff);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    const far = slider.valueAsNumber;
    meshes.forEach((mesh, k) => place(mesh, blocks[k], far));
    renderer.render(scene, camera);
  }
  slider.addEventListener("input", draw);
  controls.addEventListener("change", draw);
  addEventListener("resize", draw);
  addEventListener("beforeprint", draw);
  canvas.addEventListener("keydown", (event) => {
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    const nearer = { "+": 0.9, "-": 1 / 0.9 }[event.key];
    if (!turns && !nearer) return;
    const arm = camera.position.clone().sub(middle);
    if (turns) {
      const flat = Math.hypot(arm.x, arm.y), length = arm.length();
      const about = Math.atan2(arm.y, arm.x) + 0.1 * turns[0];
      const up = Math.min(1.5, Math.max(-0.2, Math.atan2(arm.z, flat) - 0.1 * turns[1]));
      arm.set(Math.cos(about) * Math.cos(up), Math.sin(about) * Math.cos(up), Math.sin(up)).multiplyScalar(length);
    } else {
      arm.multiplyScalar(nearer);
    }
    camera.position.copy(controls.target).add(arm);
    controls.update();
    draw();
    event.preventDefault();
  });
  draw();
}

document.querySelectorAll("figure.solid").forEach(show);
