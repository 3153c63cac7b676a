/** Runs in the page: a WebSocket that says what web-bridge would say of `count` UAVs, in tens, most of them alerting. */
export function madeUpFleet(count) {
  const kOrigin = { latitude_deg: 40.08, longitude_deg: 116.58, altitude_m: 0 };
  const kSpeed_m_s = 50;
  const columns = Math.ceil(Math.sqrt(count / 10));
  const start_ms = performance.now();
  const utime = () => 1.7e15 + (performance.now() - start_ms) * 1000;
  const placeOf = (i) => {
    const [formation, member] = [Math.floor(i / 10), i % 10];
    const side = member % 2 === 0 ? 1 : -1;
    const rank = Math.ceil(member / 2);
    return {
      east_m: (formation % columns) * 4000 + side * rank * 180,
      north_m: Math.floor(formation / columns) * 3000 - rank * 180,
      up_m: 1000 + (formation % 5) * 100,
    };
  };
  const way_m = () => ((utime() - 1.7e15) / 1e6) * kSpeed_m_s;
  const level = (i) => (i % 10 < 6 ? 1 + (i % 3) : 0);

  function frame(kind, words, bytes, fill) {
    const buffer = new ArrayBuffer(24 + count * (4 * words + bytes));
    const header = new DataView(buffer);
    header.setUint8(0, kind);
    header.setUint8(1, 1);
    header.setUint32(4, count, true);
    header.setFloat64(8, utime(), true);
    header.setFloat64(16, (utime() - 1.7e15) / 1e6, true);
    let at = 24;
    fill((Type, value) => {
      const column = new Type(buffer, at, count);
      for (let i = 0; i < count; i += 1) column[i] = value(i);
      at += column.byteLength;
    });
    return buffer;
  }

  function motion() {
    const way = way_m();
    return frame(1, 8, 1, (column) => {
      column(Int32Array, (i) => i + 1);
      column(Float32Array, (i) => placeOf(i).east_m);
      column(Float32Array, (i) => placeOf(i).north_m + way);
      column(Float32Array, (i) => placeOf(i).up_m);
      column(Float32Array, () => kSpeed_m_s);
      column(Float32Array, () => Math.PI / 2);
      column(Float32Array, () => 0);
      column(Float32Array, () => 0.02);
      column(Uint8Array, () => 0);
    });
  }

  function status() {
    return frame(2, 18, 4, (column) => {
      column(Int32Array, (i) => i + 1);
      column(Int32Array, (i) => Math.floor(i / 10) + 1);
      for (let k = 0; k < 3; k += 1) column(Float32Array, () => 5);
      const partner = (i) => (i % 2 === 0 ? i + 2 : i);
      column(Int32Array, partner);
      column(Float32Array, () => 360);
      column(Float32Array, () => 0);
      column(Int32Array, partner);
      column(Float32Array, () => 20);
      for (let k = 10; k < 17; k += 1) column(Float32Array, () => 0);
      column(Int32Array, partner);
      column(Uint8Array, level);
      column(Uint8Array, () => 0);
      column(Uint8Array, () => 0);
      column(Uint8Array, () => 3);
    });
  }

  function formationStatus(formation) {
    const way = way_m();
    const members = Array.from({ length: Math.min(10, count - formation * 10) }, (_, k) => formation * 10 + k);
    const leader = placeOf(formation * 10);
    return {
      type: "status",
      utime: utime(),
      formation_id: formation + 1,
      mode: 2,
      mode_utime: utime(),
      mode_end_utime: 0,
      mode_text: "in formation",
      leader_east_m: leader.east_m,
      leader_north_m: leader.north_m + way + 1000,
      leader_up_m: leader.up_m,
      leader_speed_m_s: kSpeed_m_s,
      leader_course_rad: Math.PI / 2,
      slots: members.map((i) => {
        const { east_m, north_m, up_m } = placeOf(i);
        return { vehicle_id: i + 1, slot_east_m: east_m + 8, slot_north_m: north_m + way + 8, slot_up_m: up_m, flown: true };
      }),
    };
  }

  window.WebSocket = class extends EventTarget {
    static OPEN = 1;
    readyState = 0;
    binaryType = "arraybuffer";
    constructor() {
      super();
      setTimeout(() => this.begin(), 200);
    }
    begin() {
      this.readyState = 1;
      this.tell("open", new Event("open"));
      const formations = Math.ceil(count / 10);
      const text = (message) => this.tell("message", new MessageEvent("message", { data: JSON.stringify(message) }));
      const binary = (data) => this.tell("message", new MessageEvent("message", { data }));
      text({ type: "hello", version: "bench", lcm_url: "", utime: utime(), tile_url: null, tile_attribution: "", tiles: null });
      const vehicles = Array.from({ length: count }, (_, i) => ({ id: i + 1, callsign: `UAV${i + 1}`, model: "default", has_payload: false }));
      text({ type: "roster", utime: utime(), scenario: `${count} UAVs`, start_utime: 1.7e15, origin: kOrigin, vehicles });
      // Without them the page asks in the middle of the map for what does not run.
      const beat = () => {
        for (const heartbeat_node of ["fleet-simulator", "formation-controller", "collision-monitor"])
          text({ type: "heartbeat", utime: utime(), heartbeat_node, gaps: 0, undecodable: 0 });
      };
      beat();
      setInterval(beat, 1000);
      // What comes before it is shown at once, when this has come.
      text({ type: "complete" });
      setInterval(() => binary(motion()), count > 100 ? 200 : 100);
      setInterval(() => binary(status()), 500);
      let next = 0;
      // Each formation five times a second, spread out as on a bus.
      setInterval(() => {
        for (let k = 0; k < formations / 5; k += 1) text(formationStatus((next = (next + 1) % formations)));
      }, 40);
    }
    tell(type, event) {
      this[`on${type}`]?.(event);
      this.dispatchEvent(event);
    }
    send() {}
    close() {}
  };
}
