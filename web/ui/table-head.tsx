import { Explained } from "./explained";

interface TableHeadProps {
  readonly titles: readonly string[];
  /** What titles mean, by title. */
  readonly meanings?: Readonly<Record<string, string>>;
}

/** The titles of the columns of a table. */
export function TableHead({ titles, meanings = {} }: TableHeadProps) {
  return (
    <thead>
      <tr>
        {titles.map((title) => {
          const meaning = meanings[title];
          return (
            <th key={title} scope="col">
              {meaning === undefined ? title : <Explained name={title} meaning={meaning} />}
            </th>
          );
        })}
      </tr>
    </thead>
  );
}
