/* The cases of the chapters that have one of their own. */
export const CHAPTER_CASES = {};
