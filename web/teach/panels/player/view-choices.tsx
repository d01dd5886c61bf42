import { NativeSelect } from "@mantine/core";
import { filmStrings } from "../../strings/film";
import { playerStrings } from "../../strings/player";
import styles from "./player.module.css";
import { useFrontPlayer, usePlayer } from "./use-player";

const texts = playerStrings;

/** What the view shows of the front, and its colours. */
export function ViewChoices() {
  const player = useFrontPlayer();
  const coloring = usePlayer((state) => state.coloring);
  const faces = usePlayer((state) => state.faces);
  const elements = usePlayer((state) => state.elements);
  const showsRegion = usePlayer((state) => state.showsRegion);
  const isVolume = usePlayer(({ step }) => step >= 0);
  return (
    <>
      <Choice
        label={texts.coloring}
        testId="player-coloring"
        value={coloring}
        choices={texts.colorings}
        onChoose={(chosen) => player.state.setState({ coloring: chosen })}
      />
      <Choice
        label={texts.shownFaces}
        testId="player-faces"
        value={faces}
        choices={texts.faceChoices}
        onChoose={(chosen) => player.state.setState({ faces: chosen })}
      />
      <Choice
        label={texts.elements}
        testId="player-elements"
        value={elements}
        choices={texts.elementChoices}
        onChoose={(chosen) => player.state.setState({ elements: chosen })}
      />
      <label className={styles["check"]} title={isVolume ? texts.regionHint : texts.regionInPlane}>
        <input
          type="checkbox"
          data-testid="player-region"
          checked={showsRegion}
          disabled={!isVolume}
          onChange={(event) => player.state.setState({ showsRegion: event.currentTarget.checked })}
        />
        {texts.searchRegion}
      </label>
    </>
  );
}

/** Whether steps are films, whether the view follows the base face, and, without films, whether the front is faded around a step. */
export function ViewChecks() {
  const player = useFrontPlayer();
  const follows = usePlayer((state) => state.follows);
  const fades = usePlayer((state) => state.fades);
  const film = usePlayer((state) => state.film);
  return (
    <>
      <label className={styles["check"]} title={filmStrings.filmHint}>
        <input
          type="checkbox"
          data-testid="player-film"
          checked={film}
          onChange={(event) => player.setFilm(event.currentTarget.checked)}
        />
        {filmStrings.film}
      </label>
      <label className={styles["check"]} title={texts.followHint}>
        <input
          type="checkbox"
          data-testid="player-follow"
          checked={follows}
          onChange={(event) => player.state.setState({ follows: event.currentTarget.checked })}
        />
        {texts.follow}
      </label>
      {!film && (
        <label className={styles["check"]} title={texts.fadeHint}>
          <input
            type="checkbox"
            data-testid="player-fade"
            checked={fades}
            onChange={(event) => player.state.setState({ fades: event.currentTarget.checked })}
          />
          {texts.fade}
        </label>
      )}
    </>
  );
}

interface ChoiceProps<Value extends string> {
  readonly label: string;
  readonly testId: string;
  readonly value: Value;
  /** The name of each value. */
  readonly choices: Readonly<Record<Value, string>>;
  readonly onChoose: (value: Value) => void;
}

function Choice<Value extends string>({ label, testId, value, choices, onChoose }: ChoiceProps<Value>) {
  const values = Object.keys(choices) as Value[];
  return (
    <label className={styles["choice"]}>
      {label}
      <NativeSelect
        size="xs"
        data-testid={testId}
        value={value}
        data={values.map((option) => ({ value: option, label: choices[option] }))}
        onChange={(event) => {
          const chosen = values.find((option) => option === event.currentTarget.value);
          if (chosen) onChoose(chosen);
        }}
      />
    </label>
  );
}
