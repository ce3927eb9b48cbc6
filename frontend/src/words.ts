/** Names as words: `CurtainOpenRequest` reads "curtain open request". Acronyms are kept. */

export function spoken(name: string): string {
  return name
    .replace(/_/g, " ")
    .replace(/(\p{Ll}|\d)(\p{Lu})/gu, "$1 $2")
    .replace(/(\p{Lu})(\p{Lu}\p{Ll})/gu, "$1 $2")
    .split(" ")
    .map((word) => (word.length > 1 && word === word.toUpperCase() ? word : word.toLowerCase()))
    .join(" ")
    .trim();
}
