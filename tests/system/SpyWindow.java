import java.awt.Component;
import java.awt.Container;
import java.awt.Window;
import java.lang.instrument.Instrumentation;
import javax.swing.JTable;
import javax.swing.Timer;

/** An agent within lcm-spy that prints the rows of the tables in its windows, once a second: `row CELL | CELL | ...`. */
public class SpyWindow {
  public static void premain(String arguments, Instrumentation instrumentation) {
    new Timer(1000, event -> {
      for (Window window : Window.getWindows()) print(window);
    }).start();
  }

  private static void print(Component component) {
    if (component instanceof JTable) {
      JTable table = (JTable) component;
      for (int row = 0; row < table.getRowCount(); ++row) {
        StringBuilder text = new StringBuilder("row");
        for (int column = 0; column < table.getColumnCount(); ++column) {
          text.append(column == 0 ? " " : " | ").append(table.getValueAt(row, column));
        }
        System.out.println(text);
      }
    }
    if (component instanceof Container) {
      for (Component child : ((Container) component).getComponents()) print(child);
    }
  }
}
