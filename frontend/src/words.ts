/** Names as words: `CurtainOpenRequest` reads "curtain open request". Acronyms keep their capital letters, and a phrase
 * of several words stays as it is. `sleec_verify/wording/names.py` does the same for the sentences of the server.
 */

export function spoken(name: string): string {
  let words = known.get(name);
  if (words === undefined) {
    if (known.size >= MOST_KNOWN) known.clear();
    words = read(name);
    known.set(name, words);
  }
  return words;
}

/** The words of the names that were read; a page draws thousands of them again and again. */
const known = new Map<string, string>();
const MOST_KNOWN = 50_000;

function read(name: string): string {
  const characters = [...name];
  if (name.includes(" ") || characters.length === 1) return name;
  const words = [""];
  characters.forEach((here, place) => {
    if (/\p{P}/u.test(here) && !"'’".includes(here)) return void words.push("");
    if (beginsWord(words.at(-1) ?? "", here, characters[place + 1] ?? "")) words.push("");
    words.push((words.pop() ?? "") + here);
  });
  const cased = words.filter(Boolean).map((word) => ([...word].length > 1 && isCapital(word) ? word : word.toLowerCase()));
  return cased.join(" ") || name;
}

/** Whether a new word begins at the character `here`. An acronym is in capital letters, and may have numbers. */
function beginsWord(word: string, here: string, after: string): boolean {
  if (isCapital(here)) return !isCapital(word) || /\p{Ll}/u.test(after);
  if (/\p{Nd}/u.test(here)) return !isCapital(word) && !isNumber(word);
  return /\p{L}/u.test(here) && (isNumber(word) || ([...word].length > 1 && isCapital(word)));
}

function isCapital(text: string): boolean {
  return text === text.toUpperCase() && text !== text.toLowerCase();
}

function isNumber(text: string): boolean {
  return /^\p{Nd}+$/u.test(text);
}
