/** The logo: a tetrahedron. */
export function Logo() {
  return (
    <svg
      width="20"
      height="20"
      viewBox="0 0 32 32"
      fill="none"
      strokeWidth="2.4"
      strokeLinejoin="round"
      aria-hidden
    >
      <path d="M16 3 29 23 16 29 3 23Z" fill="#1971c2" stroke="#4dabf7" />
      <path d="M16 3 16 29" stroke="#d0ebff" />
    </svg>
  );
}
