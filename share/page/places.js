// What the buttons say that lead to places of a mesh. Places are {name, window: [x0, y0, x1, y1]}, as named_places()
// returns them: "all", "walls", "nose:1", "tail:1", "slot:1".

/** Returns the places of a kind: "nose", "tail", "slot", "walls" or "all". */
export function placesOfKind(places, kind) {
  return places.filter(({name}) => name.split(":")[0] === kind);
}

/** Returns the text of the button of each place. Numbers are left out where there is only one. */
export function placeTexts(places) {
  const texts = {all: "far field", walls: "bodies"};
  const bodies = placesOfKind(places, "nose").length, slots = placesOfKind(places, "slot").length;
  return places.map(({name}) => {
    const [kind, number] = name.split(":");
    return texts[kind] || (bodies > 1 && kind !== "slot" || slots > 1 && kind === "slot" ? `${kind} ${number}` : kind);
  });
}
